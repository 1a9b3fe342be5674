// The video with its scrubber. The page's clock leads; the video follows it, and drives it while it
// plays.
function startPlayer() {
  const clips = [...document.querySelectorAll('script.clip')];
  const screen = byId('video');
  const video = element('video', {muted: true, playsInline: true, preload: 'auto', tabIndex: -1});
  let playing = false, started = 0, startFrame = 0;
  // A video that was made as such a window needs none.
  const following = run.config.overlay?.crop ? null : follower(video, screen);

  function source(clip) {
    if (clip.dataset.file) return clip.dataset.file;
    const text = atob(clip.textContent);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return URL.createObjectURL(new Blob([bytes], {type: 'video/mp4'}));
  }

  function choose(clip, button) {
    for (const other of byId('cameras').children) other.setAttribute('aria-pressed', other === button);
    stop();
    clip.url ??= source(clip);
    video.src = clip.url;
    following?.choose(clip.dataset.name);
    byId('video-note').textContent =
      clip.dataset.file ? `played from ${clip.dataset.file} beside this page, too large to be inside it` : '';
  }

  const seek = (frame) => {
    if (clips.length) video.currentTime = (frame + 0.5) / data.rate;
  };

  function tick() {
    if (!playing) return;
    const speed = Number(byId('rate').value);
    const frame = startFrame + (performance.now() - started) / 1000 * speed * data.rate;
    clock.show(frame, 'play');
    if (frame >= lastFrame) stop(); else requestAnimationFrame(tick);
  }

  function stop() {
    playing = false;
    video.pause();
    byId('play').textContent = 'Play';
    seek(clock.frame);
  }

  function play() {
    if (clock.frame >= lastFrame) clock.show(0);
    playing = true;
    started = performance.now();
    startFrame = clock.frame;
    byId('play').textContent = 'Pause';
    if (clips.length) {
      video.playbackRate = Number(byId('rate').value);
      video.play().catch(() => {});
    }
    requestAnimationFrame(tick);
  }

  if (clips.length) {
    screen.append(video);
    for (const clip of clips) {
      const button = element('button', {type: 'button'}, clip.dataset.name);
      button.onclick = () => choose(clip, button);
      byId('cameras').append(button);
    }
    if (following) byId('zooms').append(following.button);
    choose(clips[0], byId('cameras').firstChild);
    video.onerror = () => {
      byId('video-note').textContent = 'This browser cannot play the video; it is in the file overlay_' +
        clips[0].dataset.name + '.mp4.';
    };
  } else {
    screen.append(element('div', {className: 'message'}, 'This run wrote no overlay video.'));
  }

  const scrubber = byId('scrubber');
  scrubber.max = lastFrame;
  scrubber.oninput = () => { if (playing) stop(); clock.show(Number(scrubber.value)); };
  byId('play').onclick = () => (playing ? stop() : play());
  byId('back').onclick = () => { stop(); clock.show(clock.frame - 1); };
  byId('forward').onclick = () => { stop(); clock.show(clock.frame + 1); };
  byId('rate').onchange = () => { if (playing) { stop(); play(); } };
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (/^(INPUT|SELECT|BUTTON|SUMMARY|TEXTAREA)$/.test(event.target.tagName)) return;
    const step = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (event.key === ' ') byId('play').click();
    else if (event.key === 'z' && byId('zooms').firstChild) byId('zooms').firstChild.click();
    else if (step) { stop(); clock.show(clock.frame + step); }
    else return;
    event.preventDefault();
  });
  clock.listeners.push((frame, source) => {
    scrubber.value = frame;
    const tracked = data.joints.mean_mm[frame] ? '' : analysed ? '  empty' : '  not tracked';
    byId('now').textContent = `frame ${frame}  ${fixed(times[frame] ?? 0, 2)} s${tracked}`;
    if (source !== 'play') seek(frame);
  });
  return clips.length ? drawStrip(clips[0]) : Promise.resolve();
}

// Five moments of the first video: to jump to, and for paper.
async function drawStrip(clip) {
  const video = element('video', {muted: true, preload: 'auto', src: clip.url});
  const once = (name) => new Promise((done, fail) => {
    video.addEventListener(name, done, {once: true});
    video.addEventListener('error', fail, {once: true});
  });
  try {
    if (video.readyState < 2) await once('loadeddata');
    for (let i = 0; i < 5; ++i) {
      const frame = Math.round(lastFrame * (i + 0.5) / 5);
      const sought = once('seeked');
      video.currentTime = (frame + 0.5) / data.rate;
      await sought;
      const width = 320, height = Math.round(width * video.videoHeight / video.videoWidth);
      const canvas = element('canvas', {width, height});
      const context = canvas.getContext('2d');
      // A browser may say that it has sought before it has the picture: nothing is drawn then.
      const drawn = () => context.getImageData(0, 0, 1, 1).data[3] > 0;
      for (let tries = 0; tries < 40; ++tries) {
        context.drawImage(video, 0, 0, width, height);
        if (drawn()) break;
        await new Promise((done) => setTimeout(done, 50));
      }
      const button = element('button', {type: 'button'}, canvas, `${fixed(frame / data.rate, 2)} s`);
      button.setAttribute('aria-label', `Show frame ${frame}`);
      button.onclick = () => clock.show(frame);
      byId('strip').append(button);
    }
  } catch { /* the player says that the video cannot be played */ }
}

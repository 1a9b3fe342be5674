// A window of the video that follows the walker: joints projected by the corners of the camera's picture (without the bend
// of its lens, which a window with a margin does not show).
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const minus = (a, b) => a.map((value, i) => value - b[i]);
const unit = (a) => a.map((value) => value / Math.sqrt(dot(a, a)));
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

// Where in the picture a point is, 0 to 1 from its upper left corner; null behind the camera.
function pictureOfPoint({centre, corners}) {
  if (corners.some((corner) => corner === null)) return () => null;
  const [a, b, c, d] = corners.map((corner) => minus(corner, centre));
  const right = unit(minus(minus(b, a), minus(d, c))), downish = minus(minus(d, a), minus(b, c));
  const ahead = unit(cross(right, downish)), down = cross(ahead, right);
  const seen = (ray) => [dot(ray, right) / dot(ray, ahead), dot(ray, down) / dot(ray, ahead)];
  const low = seen(a), high = seen(c);
  return (point) => {
    const ray = minus(point, centre);
    if (dot(ray, ahead) < 0.1) return null;
    return seen(ray).map((value, i) => (value - low[i]) / (high[i] - low[i]));
  };
}

// The walker's box in every frame; null where there is none.
function boxesIn(camera) {
  const place = pictureOfPoint(camera);
  return data.joints.mean_mm.map((row, frame) => {
    if (!row) return null;
    const points = data.joints.names.map((name) => joint(frame, name)).filter(Boolean).map(place);
    if (!points.length || points.includes(null)) return null;
    const [xs, ys] = [0, 1].map((i) => points.map((point) => point[i]));
    return {x: (Math.min(...xs) + Math.max(...xs)) / 2, y: (Math.min(...ys) + Math.max(...ys)) / 2,
      size: Math.max(Math.max(...xs) - Math.min(...xs), Math.max(...ys) - Math.min(...ys))};
  });
}

const closest = 8; // times

// Lets a video follow the walker or show the whole picture. The window keeps its size, so that nothing seems to grow.
function follower(video, screen) {
  let boxes = [], times = 1, on = false;
  const show = (frame) => {
    const box = boxes.slice(0, frame + 1).findLast(Boolean) ?? boxes.find(Boolean);
    if (!on || !box) {
      video.style.transform = '';
      return;
    }
    const {clientWidth: width, clientHeight: height} = screen;
    const ratio = Math.min(width / video.videoWidth, height / video.videoHeight) || 1;
    const at = [(width - ratio * video.videoWidth) / 2 + box.x * ratio * video.videoWidth,
      (height - ratio * video.videoHeight) / 2 + box.y * ratio * video.videoHeight];
    video.style.transformOrigin = '0 0';
    video.style.transform = `translate(${width / 2 - times * at[0]}px, ${height / 2 - times * at[1]}px) scale(${times})`;
  };
  const button = element('button', {type: 'button', ariaPressed: 'false'}, 'Follow');
  button.title = 'Show a window of the video that follows the walker (z)';
  button.onclick = () => {
    on = !on;
    button.ariaPressed = String(on);
    show(clock.frame);
  };
  clock.listeners.push(show);
  video.addEventListener('loadedmetadata', () => show(clock.frame));
  new ResizeObserver(() => show(clock.frame)).observe(screen);
  return {button, choose(name) {
    const camera = data.cameras.find((each) => each.name === name);
    boxes = camera ? boxesIn(camera) : [];
    const sizes = boxes.filter(Boolean).map((box) => box.size).sort((a, b) => a - b);
    times = sizes.length ? Math.min(closest, Math.max(1, 0.8 / sizes[Math.floor(0.95 * (sizes.length - 1))])) : 1;
    button.hidden = times < 1.1;
    show(clock.frame);
  }};
}

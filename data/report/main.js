if (analysed) {
  document.querySelector('.video').hidden = true;
  document.querySelector('.stage').classList.add('alone');
  byId('scene-note').textContent = 'In space: the figure, footprints where a foot stands (filled while it does), a ground grid of 1 m. Keys: space plays, arrow keys step.';
}
verdict();
keyFigures();
gaitTables();
startCycles();
startMoreAngles();
startForces();
startTimes();
quality();
constants();
origin();
startSpace();
const videoShown = startPlayer();
const tracked = times.map((_, i) => i).filter((i) => data.joints.mean_mm[i]);
clock.show(tracked[Math.floor(tracked.length / 2)] ?? 0);
// For whoever waits until the page is complete (print services, tests).
Promise.resolve(videoShown).then(() => { document.documentElement.dataset.ready = 'true'; });

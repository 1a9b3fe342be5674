// The figure in space: bones, footprints, cameras and the ground, drawn with OGL.
const bones = [
  ['pelvis', 'neck'], ['neck', 'head'], ['lhip', 'rhip'], ['lhip', 'lknee'], ['lknee', 'lankle'],
  ['lankle', 'ltoe'], ['rhip', 'rknee'], ['rknee', 'rankle'], ['rankle', 'rtoe'],
  ['lshoulder', 'rshoulder'], ['lshoulder', 'lelbow'], ['lelbow', 'lwrist'],
  ['rshoulder', 'relbow'], ['relbow', 'rwrist'],
];
const sideOf = (a, b) => (a[0] === b[0] && 'lr'.includes(a[0]) && a !== 'pelvis' ? (a[0] === 'l' ? 'left' : 'right') : 'trunk');
const rgb = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);
// The library's world has z up, OGL y up.
const up = ([x, y, z]) => [x, z, -y];

const vertexShader = `
  attribute vec3 position, normal;
  uniform mat4 modelViewMatrix, projectionMatrix;
  uniform mat3 normalMatrix;
  varying vec3 facing;
  void main() {
    facing = normalMatrix * normal;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;
const fragmentShader = `
  precision highp float;
  uniform vec3 colour;
  uniform float opacity, lit;
  varying vec3 facing;
  void main() {
    float light = 1.0;
    if (lit > 0.5) light = 0.6 + 0.4 * max(0.0, dot(normalize(facing), normalize(vec3(0.3, 0.8, 0.5))));
    gl_FragColor = vec4(colour * light, opacity);
  }`;

function startSpace() {
  const screen = byId('space');
  let renderer;
  try {
    renderer = new OGL.Renderer({antialias: true, alpha: true, preserveDrawingBuffer: true, dpr: Math.min(2, devicePixelRatio)});
    if (!renderer.gl) throw new Error('no WebGL');
  } catch {
    screen.append(element('div', {className: 'message'}, 'This browser has no WebGL to draw the figure in space with.'));
    return;
  }
  const gl = renderer.gl;
  screen.append(gl.canvas);
  const scene = new OGL.Transform();
  const material = (hex, opacity = 1, lit = 1) => new OGL.Program(gl, {
    vertex: vertexShader, fragment: fragmentShader, transparent: opacity < 1, cullFace: false,
    depthWrite: opacity === 1,
    uniforms: {colour: {value: rgb(hex)}, opacity: {value: opacity}, lit: {value: lit}},
  });
  const add = (geometry, program, parent = scene, mode = gl.TRIANGLES) => {
    const mesh = new OGL.Mesh(gl, {geometry, program, mode});
    mesh.setParent(parent);
    return mesh;
  };
  const lines = (points, hex, opacity = 1) => {
    const position = new Float32Array(points.flatMap(up));
    const geometry = new OGL.Geometry(gl, {position: {size: 3, data: position},
      normal: {size: 3, data: new Float32Array(position.length)}});
    return add(geometry, material(hex, opacity, 0), scene, gl.LINES);
  };

  // What is in the scene at all: the track, the cameras.
  const path = times.map((_, i) => joint(i, 'pelvis')).filter(Boolean);
  const middle = [0, 1].map((axis) => path.length ? (Math.min(...path.map((p) => p[axis])) + Math.max(...path.map((p) => p[axis]))) / 2 : 0);
  const reach = Math.max(2, ...path.map((p) => Math.hypot(p[0] - middle[0], p[1] - middle[1]))) + 1;

  function drawGround() {
    const points = [], from = middle.map((m) => Math.floor(m - reach)), to = middle.map((m) => Math.ceil(m + reach));
    for (let x = from[0]; x <= to[0]; ++x) points.push([x, from[1], 0], [x, to[1], 0]);
    for (let y = from[1]; y <= to[1]; ++y) points.push([from[0], y, 0], [to[0], y, 0]);
    lines(points, '#b4bec8');
    for (const [axis, hex] of [[[0.5, 0, 0], '#c03030'], [[0, 0.5, 0], '#2f8f2f'], [[0, 0, 0.5], '#3050c0']])
      lines([[0, 0, 0.002], axis], hex);
  }

  function drawCamera(camera) {
    const shape = [];
    const corner = (i) => camera.corners[i].map((v, axis) => camera.centre[axis] + 0.6 * (v - camera.centre[axis]));
    if (camera.corners.some((c) => !c)) return;
    for (let i = 0; i < 4; ++i) shape.push(camera.centre, corner(i), corner(i), corner((i + 1) % 4));
    lines(shape, '#6a7683');
    labels.push({at: camera.centre, text: element('span', {className: 'label'}, camera.name)});
  }

  // Footprints: an ellipse along the walk, filled while the foot stands there.
  function drawContacts() {
    const round = new OGL.Cylinder(gl, {radiusTop: 1, radiusBottom: 1, height: 0.004, radialSegments: 24});
    return data.contacts.map((contact) => {
      const frame = Math.min(lastFrame, Math.max(0, Math.round(frameAt((contact.on + contact.off) / 2))));
      const side = contact.side[0], ankle = joint(frame, side + 'ankle'), toe = joint(frame, side + 'toe');
      const mesh = add(round, material(colours[contact.side], 0.35, 0));
      mesh.position.set(...up([contact.x, contact.y, 0.004]));
      mesh.scale.set(0.13, 1, 0.05);
      if (ankle && toe) mesh.rotation.y = Math.atan2(toe[1] - ankle[1], toe[0] - ankle[0]);
      return {...contact, mesh};
    });
  }

  const labels = [];
  const bone = new OGL.Cylinder(gl, {radiusTop: 1, radiusBottom: 1, height: 1, radialSegments: 12});
  const ball = new OGL.Sphere(gl, {radius: 1, widthSegments: 16, heightSegments: 12});
  const drawn = bones.map(([a, b]) => ({a, b, mesh: add(bone, material(colours[sideOf(a, b)]))}));
  const knots = data.joints.names.map((name) => ({name, mesh: add(ball, material(colours[sideOf(name, name)]))}));
  const clouds = data.joints.names.map((name) => ({name, mesh: add(ball, material(colours[sideOf(name, name)], 0.16, 0))}));
  drawGround();
  data.cameras.forEach(drawCamera);
  const contacts = drawContacts();
  for (const {text} of labels) screen.append(text);

  const camera = new OGL.Camera(gl, {fov: 35, near: 0.05, far: 500});
  const orbit = new OGL.Orbit(camera, {element: gl.canvas, ease: 1, inertia: 0, enablePan: true, minDistance: 0.5, maxDistance: 200, minPolarAngle: 0.05, maxPolarAngle: 1.62});
  let follow = true, offset = [0, -1, 0];

  const upward = new OGL.Vec3(0, 1, 0);
  function placeBone({a, b, mesh}, frame) {
    const from = joint(frame, a), to = joint(frame, b);
    mesh.visible = Boolean(from && to);
    if (!mesh.visible) return;
    const p = new OGL.Vec3(...up(from)), q = new OGL.Vec3(...up(to));
    const along = new OGL.Vec3().sub(q, p), length = along.len();
    mesh.position.set((p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2);
    const thick = sideOf(a, b) === 'trunk' ? 0.035 : 0.03;
    mesh.scale.set(thick, length, thick);
    const axis = new OGL.Vec3().cross(upward, along.normalize());
    const sine = axis.len(), angle = Math.atan2(sine, upward.dot(along));
    if (sine > 1e-6) mesh.quaternion.fromAxisAngle(axis.scale(1 / sine), angle);
    else mesh.quaternion.set(along.y > 0 ? 0 : 1, 0, 0, along.y > 0 ? 1 : 0);
  }

  // Where the joint is with 90 %, axis by axis.
  function placeCloud(name, mesh, frame) {
    const low = joint(frame, name, 'p05_mm'), high = joint(frame, name, 'p95_mm');
    mesh.visible = Boolean(low && high);
    if (!mesh.visible) return;
    mesh.position.set(...up(low.map((v, i) => (v + high[i]) / 2)));
    const [x, y, z] = low.map((v, i) => Math.max(0.001, (high[i] - v) / 2));
    mesh.scale.set(x, z, y);
  }

  function show(frame) {
    drawn.forEach((one) => placeBone(one, frame));
    for (const {name, mesh} of knots) {
      const at = joint(frame, name);
      mesh.visible = Boolean(at);
      if (at) mesh.position.set(...up(at));
      mesh.scale.set(name === 'head' ? 0.11 : 0.04);
    }
    for (const {name, mesh} of clouds) placeCloud(name, mesh, frame);
    const t = times[frame] ?? 0;
    for (const contact of contacts)
      contact.mesh.program.uniforms.opacity.value = t >= contact.on && t <= contact.off ? 0.9 : 0.3;
    const pelvis = joint(frame, 'pelvis');
    if (follow && pelvis) {
      const target = up([pelvis[0], pelvis[1], 0.9]);
      const move = new OGL.Vec3(...target).sub(orbit.target);
      orbit.target.add(move);
      camera.position.add(move);
      orbit.forcePosition();
    }
    render();
  }

  function render() {
    orbit.update();
    camera.updateMatrixWorld();
    renderer.render({scene, camera});
    const width = screen.clientWidth, height = screen.clientHeight;
    for (const {at, text} of labels) {
      const point = new OGL.Vec3(...up(at));
      const ahead = point.clone().applyMatrix4(camera.viewMatrix).z < 0;
      camera.project(point);
      text.hidden = !ahead || Math.abs(point.x) > 1 || Math.abs(point.y) > 1;
      text.style.left = `${(point.x + 1) / 2 * width}px`;
      text.style.top = `${(1 - point.y) / 2 * height}px`;
    }
  }

  // Directions to look along, relative to the way walked.
  const first = path[0] ?? [0, 0, 0], last = path[path.length - 1] ?? [1, 0, 0];
  const heading = Math.atan2(last[1] - first[1], last[0] - first[0]);
  const looks = {
    'side': () => around(heading - Math.PI / 2, 0.15, 4.2, true),
    'front': () => around(heading + 0.15, 0.2, 4.2, true),
    'above': () => around(heading - Math.PI / 2, 1.45, 2.6 * reach, false),
    'all': () => around(heading - Math.PI / 3, 0.45, 3.2 * Math.max(reach, ...data.cameras.map((c) => 0.55 * Math.hypot(c.centre[0] - middle[0], c.centre[1] - middle[1]))), false),
  };
  function around(angle, rise, distance, follows) {
    follow = follows;
    const pelvis = joint(clock.frame, 'pelvis');
    const centre = follows && pelvis ? [pelvis[0], pelvis[1], 0.9] : [middle[0], middle[1], 0.6];
    orbit.target.set(...up(centre));
    camera.position.set(...up([centre[0] + distance * Math.cos(rise) * Math.cos(angle),
      centre[1] + distance * Math.cos(rise) * Math.sin(angle), centre[2] + distance * Math.sin(rise)]));
    orbit.forcePosition();
    show(clock.frame);
  }
  for (const [name, look] of Object.entries(looks)) {
    const button = element('button', {type: 'button'}, name);
    button.onclick = () => {
      for (const other of byId('views').children) other.setAttribute('aria-pressed', other === button);
      look();
    };
    byId('views').append(button);
  }
  gl.canvas.tabIndex = 0;
  gl.canvas.setAttribute('aria-label', 'The walking figure in space; drag or use the buttons below to turn it');
  for (const kind of ['mousemove', 'wheel', 'touchmove', 'mouseup', 'touchend'])
    window.addEventListener(kind, () => requestAnimationFrame(render), {passive: true});

  const resize = () => {
    const width = screen.clientWidth, height = screen.clientHeight;
    if (!width || !height) return;
    renderer.setSize(width, height);
    gl.canvas.style.width = gl.canvas.style.height = '';
    camera.perspective({aspect: width / height});
    render();
  };
  new ResizeObserver(resize).observe(screen);
  resize();
  byId('views').firstChild.click();
  clock.listeners.push(show);
}

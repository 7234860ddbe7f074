// The view of a run's fragments: turned, zoomed, moved apart. The way apart is done by the graphics processor.

const apartChunk = "attribute vec3 centre; uniform float apart;\n" +
                   "vec4 placed() { return modelViewMatrix * vec4(position + apart * centre, 1.0); }\n";

function makeMaterials() {
  const apart = {value: 0};
  const surface = new THREE.ShaderMaterial({
    uniforms: {apart}, side: THREE.DoubleSide,
    vertexShader: apartChunk + `
      attribute vec3 tint; varying vec3 colour, n, eye, up;
      void main() {
        vec4 x = placed();
        colour = tint; n = normalMatrix * normal; eye = -x.xyz; up = normalMatrix * vec3(0.0, 0.0, 1.0);
        gl_Position = projectionMatrix * x;
      }`,
    fragmentShader: `
      varying vec3 colour, n, eye, up;
      void main() {
        vec3 m = normalize(n), v = normalize(eye);
        if (!gl_FrontFacing) m = -m;
        vec3 key = normalize(vec3(-0.55, 0.75, 0.6)), fill = normalize(vec3(0.8, 0.1, 0.5));
        float sky = 0.5 + 0.5 * dot(m, normalize(up));
        float light = 0.44 + 0.19 * sky + 0.40 * max(dot(m, key), 0.0) + 0.16 * max(dot(m, fill), 0.0);
        float gloss = 0.1 * pow(max(dot(m, normalize(key + v)), 0.0), 30.0);
        gl_FragColor = vec4(colour * light + gloss, 1.0);
      }`});
  const labels = new THREE.ShaderMaterial({
    uniforms: {apart}, side: THREE.DoubleSide,
    vertexShader: apartChunk + "attribute vec3 label; varying vec3 own;\n" +
                  "void main() { own = label; gl_Position = projectionMatrix * placed(); }",
    fragmentShader: "varying vec3 own; void main() { gl_FragColor = vec4(own, 1.0); }"});
  const lines = new THREE.ShaderMaterial({
    uniforms: {apart}, transparent: true, depthWrite: false,
    vertexShader: apartChunk + "void main() { vec4 x = placed(); x.xyz *= 0.998; gl_Position = projectionMatrix * x; }",
    fragmentShader: "void main() { gl_FragColor = vec4(0.08, 0.09, 0.1, 0.55); }"});
  const wall = new THREE.ShaderMaterial({
    uniforms: {ring: {value: 1}}, side: THREE.DoubleSide, transparent: true, depthWrite: false,
    extensions: {derivatives: true},
    vertexShader: `
      varying vec2 place;
      void main() { place = position.xy; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
    fragmentShader: `
      varying vec2 place; uniform float ring;
      void main() {
        float r = length(place), away = 1.0 - smoothstep(0.35, 1.0, r / 3.6);
        float line = 1.0 - smoothstep(0.0, 1.4, abs(fract(r / ring - 0.5) - 0.5) / fwidth(r / ring));
        float shade = 0.10 * away + 0.26 * exp(-2.2 * r * r) + 0.16 * line * away;
        gl_FragColor = vec4(vec3(0.35, 0.38, 0.42), shade);
      }`});
  return {surface, labels, lines, wall, apart};
}

// 1, 2 or 5 times a power of ten, not above `length`.
function roundLength(length) {
  const power = 10 ** Math.floor(Math.log10(length));
  return power * [5, 2, 1].find(step => step * power <= length * (1 + 1e-9));
}
function lengthText(metres) {
  const [unit, name] = [[1, "m"], [1e-3, "mm"], [1e-6, "µm"], [1e-9, "nm"]].find(([size]) => metres >= 0.099 * size) ||
                       [1e-9, "nm"];
  return `${+(metres / unit).toPrecision(3)} ${name}`;
}

const startView = {azimuth: -62, elevation: 14, zoom: 1, shift: [0, 0]};
const clamped = (x, low, high) => Math.min(Math.max(x, low), high);

// What a person does to the canvas, as changes of `view`.
function listen(canvas, view, changed) {
  const pointers = new Map();
  const turn = (dx, dy) => {
    view.azimuth -= dx;
    view.elevation = clamped(view.elevation + dy, -89, 89);
  };
  const zoom = factor => { view.zoom = clamped(view.zoom * factor, 0.05, 20); };
  const move = (dx, dy) => {
    const scale = 2.2 / canvas.clientHeight / view.zoom;
    view.shift[0] -= dx * scale;
    view.shift[1] += dy * scale;
  };
  const span = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    canvas.focus({preventScroll: true});
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  });
  canvas.addEventListener("pointermove", event => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const dx = event.clientX - last.x, dy = event.clientY - last.y, before = pointers.size === 2 ? span() : 0;
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    if (pointers.size === 2) {
      zoom(span() / (before || 1));
      move(dx / 2, dy / 2);
    } else if (event.shiftKey || event.buttons & 6) {
      move(dx, dy);
    } else {
      turn(0.4 * dx, 0.4 * dy);
    }
    changed();
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, event => pointers.delete(event.pointerId));
  canvas.addEventListener("contextmenu", event => event.preventDefault());
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    zoom(Math.exp(-0.0012 * clamped(event.deltaY * (event.deltaMode === 1 ? 16 : 1), -300, 300)));
    changed();
  }, {passive: false});
  const keys = {ArrowLeft: () => turn(-6, 0), ArrowRight: () => turn(6, 0), ArrowUp: () => turn(0, 6),
                ArrowDown: () => turn(0, -6), "+": () => zoom(1.15), "=": () => zoom(1.15), "-": () => zoom(1 / 1.15),
                Home: () => Object.assign(view, structuredClone(startView))};
  canvas.addEventListener("keydown", event => {
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
    changed();
  });
}

// A viewer on `canvas`, or null where the browser has no WebGL.
function makeViewer(canvas) {
  let renderer;
  const probe = document.createElement("canvas");
  if (!probe.getContext("webgl") && !probe.getContext("experimental-webgl")) return null;
  try {
    renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: true, preserveDrawingBuffer: true});
  } catch (error) {
    return null;
  }
  renderer.setClearColor(0xffffff, 0);
  const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(28, 1, 0.05, 400);
  camera.up.set(0, 0, 1);
  const materials = makeMaterials(), view = structuredClone(startView);
  const wall = new THREE.Mesh(new THREE.CircleBufferGeometry(3.6, 96), materials.wall);
  const shown = {apart: 0, fines: true, lines: true, wall: true};
  const onePixel = new THREE.WebGLRenderTarget(1, 1);
  let data = null, fragments = [], surface = null, lines = null, size = null, isDue = false;

  function placeCamera() {
    const width = canvas.clientWidth || 1, height = canvas.clientHeight || 1;
    renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    if (size && size.fitted !== shown.apart)
      Object.assign(size, {fitted: shown.apart, reach: radiusApart(data, size, shown.apart)});
    const half = Math.atan(Math.tan(camera.fov * Math.PI / 360) * Math.min(1, camera.aspect));
    const distance = 1.2 * Math.max(size ? size.reach : 1, 1) / Math.sin(half) / view.zoom;
    const [a, e] = [view.azimuth * Math.PI / 180, view.elevation * Math.PI / 180];
    const away = new THREE.Vector3(Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e));
    const right = new THREE.Vector3(-Math.sin(a), Math.cos(a), 0), up = away.clone().cross(right);
    const target = right.multiplyScalar(view.shift[0]).add(up.multiplyScalar(view.shift[1]));
    camera.position.copy(target).addScaledVector(away, distance);
    camera.lookAt(target);
    camera.near = Math.max(0.02, distance - 12);
    camera.far = distance + 60;
    camera.updateProjectionMatrix();
  }

  function draw() {
    isDue = false;
    placeCamera();
    materials.apart.value = shown.apart;
    if (size) {
      for (const part of [surface, lines])
        part.object.geometry.setDrawRange(0, shown.fines ? part.count : part.mainCount);
      lines.object.visible = shown.lines;
      wall.visible = shown.wall && size.hasWall;
      wall.position.z = -(1 + shown.apart) * size.centre[2] / size.radius;  // the wall too moves away from the centre
      materials.wall.uniforms.ring.value = size.ring / size.radius;
    }
    renderer.render(scene, camera);
  }
  function changed() {
    if (!isDue) requestAnimationFrame(draw);
    isDue = true;
  }

  // The fragment seen at a place of the canvas, if any: its label is drawn into one pixel.
  function fragmentAt(x, y) {
    if (!size) return null;
    const hidden = [lines.object, wall].filter(object => object.visible), pixel = new Uint8Array(4);
    for (const object of hidden) object.visible = false;
    surface.object.material = materials.labels;
    camera.setViewOffset(canvas.clientWidth, canvas.clientHeight, Math.floor(x), Math.floor(y), 1, 1);
    renderer.setRenderTarget(onePixel);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.readRenderTargetPixels(onePixel, 0, 0, 1, 1, pixel);
    renderer.setRenderTarget(null);
    camera.clearViewOffset();
    surface.object.material = materials.surface;
    for (const object of hidden) object.visible = true;
    return pixel[3] ? fragments[rankOf(pixel)] || null : null;
  }

  function drop(part) {
    scene.remove(part.object);
    part.object.geometry.dispose();
  }
  function add(part, object) {
    object.frustumCulled = false;
    scene.add(object);
    return {...part, object};
  }

  listen(canvas, view, changed);
  new ResizeObserver(changed).observe(canvas);
  scene.add(wall);
  wall.visible = false;
  return {
    // Shows a frame; returns its fragments and the distance of the rings on the wall [m], 0 = no wall.
    async show(frame, base64) {
      const read = await unpacked(frame, base64);
      if (size) [surface, lines].forEach(drop);
      data = read;
      fragments = listed(data);
      size = measured(data, fragments);
      size.hasWall = frame.wall && size.lowest > -0.1 * size.radius;
      size.ring = roundLength(0.7 * size.radius);
      const skin = surfaceGeometry(data, fragments, size), edges = lineGeometry(data, fragments, size);
      surface = add(skin, new THREE.Mesh(skin.geometry, materials.surface));
      lines = add(edges, new THREE.LineSegments(edges.geometry, materials.lines));
      lines.object.renderOrder = 1;
      wall.renderOrder = 2;
      changed();
      return {fragments, ring: size.hasWall ? size.ring : 0};
    },
    fragmentAt,
    set(changes) {
      Object.assign(shown, changes);
      changed();
    },
    reset() {
      Object.assign(view, structuredClone(startView));
      changed();
    },
    // The view as the source of an image, on white if asked for.
    picture(onWhite) {
      renderer.setClearColor(0xffffff, onWhite ? 1 : 0);
      draw();
      const url = canvas.toDataURL("image/png");
      renderer.setClearColor(0xffffff, 0);
      draw();
      return url;
    }
  };
}

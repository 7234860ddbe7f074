"use strict";
// The fragments of a run in 3-D: turned, zoomed, moved apart. Lengths are scaled so that the large fragments fit a ball
// of radius 1 about their common centre; the way apart is done by the graphics processor.

const finesShare = 1e-3;  // of the volume, as in a run's picture
const mainShare = 0.98;   // what the view is fitted to: small pieces may fly out of it
const palette = [[78, 121, 167], [242, 142, 43], [89, 161, 79], [225, 87, 89], [118, 183, 178], [237, 201, 72],
                 [176, 122, 161], [156, 117, 95], [255, 157, 167], [160, 203, 232], [255, 190, 125], [140, 209, 125],
                 [212, 166, 200], [182, 153, 45], [73, 152, 148], [215, 181, 166]];
const finesColour = [150, 150, 150];
const freshFracture = [240, 236, 228];

const mixed = (a, b, share) => a.map((x, i) => Math.round(x + share * (b[i] - x)));
const percent = share => (100 * share).toFixed(share < 0.001 ? 2 : 1) + " %";

// ---- reading ----

async function inflated(base64) {
  if (typeof DecompressionStream === "undefined") throw new Error("This browser cannot unpack the data: it is too old.");
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Arrays out of planes of bytes, one after the other.
function planeReader(bytes) {
  let place = 0;
  return (count, width) => {
    const values = new Uint32Array(count);
    for (let plane = 0; plane < width; ++plane)
      for (let i = 0; i < count; ++i) values[i] |= bytes[place++] << 8 * plane;
    return values;
  };
}

async function unpacked(frame, base64) {
  const bytes = await inflated(base64), take = planeReader(bytes);
  const floats = count => new Float32Array(take(count, 4).buffer);
  const pointsOf = take(frame.fragments, 4), trianglesOf = take(frame.fragments, 4);
  const share = floats(frame.fragments), centres = floats(3 * frame.fragments);
  const position = new Float64Array(3 * frame.points), centre = new Float64Array(3 * frame.fragments);
  for (let axis = 0; axis < 3; ++axis) {
    const steps = take(frame.points, 2);
    let now = 0;
    for (let i = 0; i < frame.points; ++i) {
      now = (now + steps[i]) & 0xffff;
      position[3 * i + axis] = frame.origin[axis] + frame.step * now;
    }
    for (let f = 0; f < frame.fragments; ++f) centre[3 * f + axis] = centres[axis * frame.fragments + f];
  }
  const corners = take(3 * frame.triangles, 4);
  let next = 0;
  for (let i = 0; i < corners.length; ++i) {
    corners[i] = next - corners[i];
    if (corners[i] === next) ++next;
  }
  return {pointsOf, trianglesOf, share, centre, position, corners, isFracture: take(frame.triangles, 1)};
}

// ---- what is drawn ----

// The ranges of triangles and points of each fragment, and which are fines.
function listed(data) {
  const fragments = [];
  let point = 0, triangle = 0;
  for (let f = 0; f < data.share.length; ++f) {
    fragments.push({rank: f, share: data.share[f], isFine: f > 0 && data.share[f] < finesShare,
                    points: [point, point += data.pointsOf[f]], triangles: [triangle, triangle += data.trianglesOf[f]]});
  }
  return fragments;
}

// How far the heaviest fragments reach from their common centre when they are moved apart [size.radius].
function radiusApart(data, size, apart) {
  let square = 0;
  for (const {rank, points} of size.main) {
    const [cx, cy, cz] = [0, 1, 2].map(k => apart * data.centre[3 * rank + k] - (1 + apart) * size.centre[k]);
    for (let i = 3 * points[0]; i < 3 * points[1]; i += 3) {
      const x = data.position[i] + cx, y = data.position[i + 1] + cy, z = data.position[i + 2] + cz;
      square = Math.max(square, x * x + y * y + z * z);
    }
  }
  return Math.sqrt(square) / size.radius;
}

// Centre, radius and lowest point of the heaviest fragments.
function measured(data, fragments) {
  const centre = [0, 0, 0], main = [];
  let volume = 0, heavier = 0;
  for (const fragment of fragments.filter(f => !f.isFine)) {
    for (let k = 0; k < 3; ++k) centre[k] += fragment.share * data.centre[3 * fragment.rank + k];
    volume += fragment.share;
    if (heavier < mainShare) main.push(fragment);
    heavier += fragment.share;
  }
  for (let k = 0; k < 3; ++k) centre[k] /= volume || 1;
  const size = {centre, main, radius: 1, lowest: Infinity};
  size.radius = radiusApart(data, size, 0) || 1;
  for (const {points} of main) for (let i = points[0]; i < points[1]; ++i) size.lowest = Math.min(size.lowest, data.position[3 * i + 2]);
  return size;
}

// The unit normal of each triangle times its area, and of each point the sum over the skin around it.
function normalsOf(data) {
  const {position: x, corners} = data, faces = new Float64Array(corners.length), skin = new Float64Array(x.length);
  for (let t = 0; t < corners.length; t += 3) {
    const [a, b, c] = [3 * corners[t], 3 * corners[t + 1], 3 * corners[t + 2]];
    const [ux, uy, uz] = [x[b] - x[a], x[b + 1] - x[a + 1], x[b + 2] - x[a + 2]];
    const [vx, vy, vz] = [x[c] - x[a], x[c + 1] - x[a + 1], x[c + 2] - x[a + 2]];
    faces[t] = uy * vz - uz * vy;
    faces[t + 1] = uz * vx - ux * vz;
    faces[t + 2] = ux * vy - uy * vx;
    if (data.isFracture[t / 3]) continue;
    for (const p of [a, b, c]) for (let k = 0; k < 3; ++k) skin[p + k] += faces[t + k];
  }
  for (const normals of [faces, skin])
    for (let i = 0; i < normals.length; i += 3) {
      const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
      for (let k = 0; k < 3; ++k) normals[i + k] /= length;
    }
  return {faces, skin};
}

// Points with the centre of their fragment; large fragments first, so that the fines are the tail.
function pointBuffers(count) {
  return {position: new Float32Array(3 * count), centre: new Float32Array(3 * count), size: 0};
}
function addPoint(buffers, data, size, point, fragment) {
  const i = 3 * buffers.size++;
  for (let k = 0; k < 3; ++k) {
    buffers.position[i + k] = (data.position[3 * point + k] - size.centre[k]) / size.radius;
    buffers.centre[i + k] = (data.centre[3 * fragment.rank + k] - size.centre[k]) / size.radius;
  }
  return i;
}

const mainFirst = fragments => [...fragments.filter(f => !f.isFine), ...fragments.filter(f => f.isFine)];

function surfaceGeometry(data, fragments, size) {
  const buffers = pointBuffers(data.corners.length), {faces, skin} = normalsOf(data);
  const normal = new Float32Array(3 * data.corners.length), tint = new Uint8Array(3 * data.corners.length);
  const crease = Math.cos(Math.PI / 5);
  let mainCount = 0;
  for (const fragment of mainFirst(fragments)) {
    const colour = fragment.isFine ? finesColour : palette[fragment.rank % palette.length];
    const fracture = mixed(colour, freshFracture, 0.6);
    for (let t = fragment.triangles[0]; t < fragment.triangles[1]; ++t) {
      const face = faces.subarray(3 * t, 3 * t + 3), isFracture = data.isFracture[t];
      for (let k = 0; k < 3; ++k) {
        const point = data.corners[3 * t + k], smooth = skin.subarray(3 * point, 3 * point + 3);
        const isSmooth = !isFracture && face[0] * smooth[0] + face[1] * smooth[1] + face[2] * smooth[2] > crease;
        const i = addPoint(buffers, data, size, point, fragment);
        normal.set(isSmooth ? smooth : face, i);
        tint.set(isFracture ? fracture : colour, i);
      }
    }
    if (!fragment.isFine) mainCount = buffers.size;
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(buffers.position, 3));
  geometry.setAttribute("centre", new THREE.BufferAttribute(buffers.centre, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(normal, 3));
  geometry.setAttribute("tint", new THREE.BufferAttribute(tint, 3, true));
  return {geometry, mainCount, count: buffers.size};
}

// The edges at which a crack meets the skin.
function lineGeometry(data, fragments, size) {
  const ends = [], num = data.position.length / 3;
  let mainCount = 0;
  for (const fragment of mainFirst(fragments)) {
    const skin = new Set();
    const eachEdge = (fracture, visit) => {
      for (let t = fragment.triangles[0]; t < fragment.triangles[1]; ++t)
        for (let k = 0; k < 3 && Boolean(data.isFracture[t]) === fracture; ++k) {
          const a = data.corners[3 * t + k], b = data.corners[3 * t + (k + 1) % 3];
          visit(Math.min(a, b), Math.max(a, b));
        }
    };
    eachEdge(false, (a, b) => skin.add(a * num + b));
    eachEdge(true, (a, b) => { if (skin.delete(a * num + b)) ends.push([a, fragment], [b, fragment]); });
    if (!fragment.isFine) mainCount = ends.length;
  }
  const buffers = pointBuffers(ends.length);
  for (const [point, fragment] of ends) addPoint(buffers, data, size, point, fragment);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(buffers.position, 3));
  geometry.setAttribute("centre", new THREE.BufferAttribute(buffers.centre, 3));
  return {geometry, mainCount, count: ends.length};
}

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
  return {surface, lines, wall, apart};
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

// ---- the view ----

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
  let data = null, surface = null, lines = null, size = null, isDue = false;

  function placeCamera() {
    const width = canvas.clientWidth || 1, height = canvas.clientHeight || 1;
    renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    renderer.setSize(width, height, false);
    camera.aspect = width / height;
    if (size && size.fitted !== shown.apart) Object.assign(size, {fitted: shown.apart, reach: radiusApart(data, size, shown.apart)});
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
      for (const part of [surface, lines]) part.object.geometry.setDrawRange(0, shown.fines ? part.count : part.mainCount);
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
      const unpackedData = await unpacked(frame, base64), fragments = listed(unpackedData);
      if (size) [surface, lines].forEach(drop);
      data = unpackedData;
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

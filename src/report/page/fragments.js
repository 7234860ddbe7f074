"use strict";
// The surfaces of a run's fragments, from the bytes in the page to what the graphics processor draws. Lengths are scaled
// so that the large fragments fit a ball of radius 1 about their common centre.

const finesShare = 1e-3;  // of the volume, as in a run's picture
const mainShare = 0.98;   // what the view is fitted to: small pieces may fly out of it
const palette = [[78, 121, 167], [242, 142, 43], [89, 161, 79], [225, 87, 89], [118, 183, 178], [237, 201, 72],
                 [176, 122, 161], [156, 117, 95], [255, 157, 167], [160, 203, 232], [255, 190, 125], [140, 209, 125],
                 [212, 166, 200], [182, 153, 45], [73, 152, 148], [215, 181, 166]];
const finesColour = [150, 150, 150];
const freshFracture = [240, 236, 228];

const mixed = (a, b, share) => a.map((x, i) => Math.round(x + share * (b[i] - x)));
const percent = share => (100 * share).toFixed(share < 0.001 ? 2 : 1) + " %";

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
  for (const {points} of main)
    for (let i = points[0]; i < points[1]; ++i) size.lowest = Math.min(size.lowest, data.position[3 * i + 2]);
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

// A fragment's rank as a colour, none black.
const labelOf = rank => [rank + 1 & 255, rank + 1 >> 8 & 255, rank + 1 >> 16];
const rankOf = ([r, g, b]) => r + 256 * g + 65536 * b - 1;

const mainFirst = fragments => [...fragments.filter(f => !f.isFine), ...fragments.filter(f => f.isFine)];

function surfaceGeometry(data, fragments, size) {
  const buffers = pointBuffers(data.corners.length), {faces, skin} = normalsOf(data);
  const normal = new Float32Array(3 * data.corners.length), tint = new Uint8Array(3 * data.corners.length);
  const label = new Uint8Array(3 * data.corners.length);
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
        label.set(labelOf(fragment.rank), i);
      }
    }
    if (!fragment.isFine) mainCount = buffers.size;
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(buffers.position, 3));
  geometry.setAttribute("centre", new THREE.BufferAttribute(buffers.centre, 3));
  geometry.setAttribute("normal", new THREE.BufferAttribute(normal, 3));
  geometry.setAttribute("tint", new THREE.BufferAttribute(tint, 3, true));
  geometry.setAttribute("label", new THREE.BufferAttribute(label, 3, true));
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

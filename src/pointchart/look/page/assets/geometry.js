// What is computed of the mesh before it is drawn, and the little algebra that it takes.

// The sides of loops that lie one after the other.
function sidesOf(corners, sizes) {
  const sides = new Uint32Array(2 * corners.length);
  let begin = 0;
  for (const size of sizes) {
    for (let k = 0; k < size; k++) sides.set([corners[begin + k], corners[begin + ((k + 1) % size)]], 2 * (begin + k));
    begin += size;
  }
  return sides;
}

// Each edge once, from its lower end to its upper one: sorted by both in one number, then the repeats dropped.
function uniqueEdges(triangles) {
  const keys = new Float64Array(triangles.length);
  for (let k = 0; k < triangles.length; k++) {
    const a = triangles[k], b = triangles[k % 3 === 2 ? k - 2 : k + 1];
    keys[k] = Math.min(a, b) * 67108864 + Math.max(a, b);
  }
  keys.sort();
  const edges = new Uint32Array(2 * keys.length);
  let size = 0;
  for (let k = 0; k < keys.length; k++) {
    if (k > 0 && keys[k] === keys[k - 1]) continue;
    edges[size++] = Math.floor(keys[k] / 67108864);
    edges[size++] = keys[k] % 67108864;
  }
  return edges.slice(0, size);
}

function ringsOf(edges, count) {
  const begin = new Uint32Array(count + 2);
  for (const end of edges) begin[end + 2]++;
  for (let k = 0; k < count; k++) begin[k + 2] += begin[k + 1];
  const ends = new Uint32Array(edges.length);
  for (let k = 0; k < edges.length; k++) ends[begin[edges[k] + 1]++] = edges[k ^ 1];
  return (vertex) => ends.subarray(begin[vertex], begin[vertex + 1]);
}

function vertexNormals(position, triangles, count) {
  const normals = new Float32Array(3 * count);
  for (let k = 0; k < triangles.length; k += 3) {
    const [a, b, c] = [3 * triangles[k], 3 * triangles[k + 1], 3 * triangles[k + 2]];
    const ux = position[b] - position[a], uy = position[b + 1] - position[a + 1], uz = position[b + 2] - position[a + 2];
    const vx = position[c] - position[a], vy = position[c + 1] - position[a + 1], vz = position[c + 2] - position[a + 2];
    const n = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    for (const corner of [a, b, c]) for (let d = 0; d < 3; d++) normals[corner + d] += n[d];
  }
  for (let k = 0; k < normals.length; k += 3) {
    const length = Math.hypot(normals[k], normals[k + 1], normals[k + 2]) || 1;
    for (let d = 0; d < 3; d++) normals[k + d] /= length;
  }
  return normals;
}

// Middle and radius of the mesh in space; from where it is seen at first comes with the page.
function frameOfSpace(position, turn) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let k = 0; k < position.length; k++) {
    const d = k % 3, x = position[k] / 65535;
    low[d] = Math.min(low[d], x);
    high[d] = Math.max(high[d], x);
  }
  const center = low.map((x, d) => (x + high[d]) / 2);
  let radius = 0;
  for (let k = 0; k < position.length; k += 3) {
    radius = Math.max(radius, Math.hypot(...center.map((c, d) => position[k + d] / 65535 - c)));
  }
  return { turn, center, radius: radius || 1 };
}

function frameOfPlane(uv) {
  const low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (let k = 0; k < uv.length; k++) {
    low[k % 2] = Math.min(low[k % 2], uv[k]);
    high[k % 2] = Math.max(high[k % 2], uv[k]);
  }
  return { center: low.map((x, d) => (x + high[d]) / 2), radius: Math.max(high[0] - low[0], high[1] - low[1]) / 2 || 1 };
}

// A turn about the vertical and then the horizontal axis of the screen, in radians.
function turned(turn, across, down) {
  const about = (i, j, angle, m) => {
    const c = Math.cos(angle), s = Math.sin(angle), out = m.slice();
    for (let k = 0; k < 3; k++) {
      out[3 * i + k] = c * m[3 * i + k] - s * m[3 * j + k];
      out[3 * j + k] = s * m[3 * i + k] + c * m[3 * j + k];
    }
    return out;
  };
  return about(1, 2, down, about(2, 0, across, turn));
}

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

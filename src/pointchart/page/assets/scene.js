// Both views of the mesh in one WebGL canvas: in space, turned by the user, and in the parameter plane.

const VERTEX = `#version 300 es
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec3 normal;
layout(location = 3) in float shade;
uniform mat4 view;
uniform mat3 turn;
uniform bool isPlane;
uniform float nearer;
out vec3 facing;
out float value;
flat out uint name;
void main() {
  facing = turn * normal;
  value = shade;
  name = uint(gl_VertexID) + 1u;
  gl_Position = view * vec4(isPlane ? vec3(uv, 0.0) : position, 1.0);
  gl_Position.z -= nearer * gl_Position.w;
}`;
const FRAGMENT = `#version 300 es
precision highp float;
in vec3 facing;
in float value;
flat in uint name;
uniform int mode;
uniform bool isFlat;
uniform vec4 plain;
uniform vec2 reach;
uniform sampler2D palette;
out vec4 color;
const vec3 BACK = vec3(0.72, 0.45, 0.38);
const vec3 LIGHT = vec3(-0.4472, 0.5466, 0.7081);
void main() {
  if (mode == 0) { color = plain; return; }
  if (mode == 1) { color = vec4(name & 255u, (name >> 8) & 255u, (name >> 16) & 255u, 255u) / 255.0; return; }
  vec3 n = normalize(facing);
  // In the plane all sides of the surface are seen at once, so that light has to reach round it.
  float lit = isFlat ? 0.5 + 0.5 * dot(n, LIGHT) : max(dot(n, LIGHT), 0.0);
  vec3 base = mode == 2 ? plain.rgb : texture(palette, vec2((value - reach.x) / (reach.y - reach.x), 0.5)).rgb;
  float shine = mode == 2 ? 0.42 + 0.62 * lit : 0.62 + 0.4 * lit;
  if (!gl_FrontFacing) {
    base = mode == 2 ? BACK : mix(base, BACK, 0.6);
    shine = 0.42 + 0.62 * max(-dot(n, LIGHT), 0.0);
  }
  color = vec4(base * shine, 1.0);
}`;

class Scene {
  constructor(canvas, panes, arrays, turn) {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: true, premultipliedAlpha: true });
    if (!gl) throw new Error("this browser has no WebGL 2, which draws the mesh; all else on this page is here");
    Object.assign(this, { canvas, panes, gl, arrays });
    this.count = arrays.uv.length / 2;
    this.edges = uniqueEdges(arrays.triangles);
    this.rings = ringsOf(this.edges, this.count);
    this.normals = vertexNormals(arrays.position, arrays.triangles, this.count);
    this.frame = frameOfSpace(arrays.position, turn);
    this.plane = frameOfPlane(arrays.uv);
    this.options = { wires: false, rim: true, shade: null, reach: [0, 1] };
    this._build();
    this.reset();
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => { this._build(); this.setShade(this.options.shade, this.options.reach, this.colors); });
  }

  _build() {
    const gl = this.gl, { position, uv, triangles } = this.arrays;
    this.program = linked(gl);
    this.places = Object.fromEntries(["view", "turn", "isPlane", "isFlat", "nearer", "mode", "plain", "reach", "palette"].map((name) => [name, gl.getUniformLocation(this.program, name)]));
    this.mesh = gl.createVertexArray();
    gl.bindVertexArray(this.mesh);
    const centred = new Float32Array(position.length);
    for (let k = 0; k < position.length; k++) centred[k] = position[k] / 65535 - this.frame.center[k % 3];
    this.centred = centred;
    attribute(gl, 0, centred, 3, gl.FLOAT, false);
    attribute(gl, 1, uv, 2, gl.FLOAT, false);
    attribute(gl, 2, this.normals, 3, gl.FLOAT, false);
    this.shadeBuffer = attribute(gl, 3, new Uint16Array(this.count), 1, gl.UNSIGNED_SHORT, true);
    this.faceBuffer = indexBuffer(gl, triangles);
    this.edgeBuffer = indexBuffer(gl, this.edges);
    const rim = sidesOf(this.arrays.loop, this.arrays.loop_sizes);
    this.rimBuffer = indexBuffer(gl, rim);
    this.rimLength = rim.length;
    this.palette = gl.createTexture();
    this.pickTarget = pickTarget(gl);
  }

  reset() {
    this.turn = this.frame.turn.slice();
    this.zoom = { space: 1, plane: 1 };
    this.shift = { space: [0, 0], plane: [0, 0] };
    this.draw();
  }

  // Face a vertex, in the middle of both views, so near that its edges are seen.
  visit(vertex) {
    const ahead = Array.from(this.normals.subarray(3 * vertex, 3 * vertex + 3)), upright = this.frame.turn.slice(3, 6);
    const right = unit(cross(Math.abs(dot(upright, ahead)) < 0.95 ? upright : this.frame.turn.slice(6, 9), ahead));
    this.turn = [...right, ...cross(ahead, right), ...ahead];
    for (const which of ["space", "plane"]) {
      const here = this._point(which, vertex), { radius } = which === "space" ? this.frame : this.plane;
      const reach = Math.max(...Array.from(this.rings(vertex), (other) => {
        const there = this._point(which, other);
        return Math.hypot(...[0, 1, 2].map((d) => there[d] - here[d]));
      }));
      this.zoom[which] = Math.min(Math.max((0.12 * radius) / (reach || 1), 1), 1e6);
      this.shift[which] = [0, 0];
      const spot = this.spot(which, vertex), box = this.box(which);
      this.shift[which] = [1 - (2 * (spot.x - box.x)) / box.width, (2 * (spot.y - box.y)) / box.height - 1];
    }
    this.draw();
  }

  setShade(values, reach, colors) {
    const gl = this.gl;
    Object.assign(this.options, { shade: values, reach });
    this.colors = colors;
    if (values) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.shadeBuffer);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
      gl.bindTexture(gl.TEXTURE_2D, this.palette);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, colors.length / 4, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, colors);
      for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, side, gl.CLAMP_TO_EDGE);
      for (const way of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, way, gl.LINEAR);
    }
    this.draw();
  }

  // The place of a pane in the canvas, in CSS pixels.
  box(which) {
    const pane = this.panes[which].getBoundingClientRect(), whole = this.canvas.getBoundingClientRect();
    return { x: pane.left - whole.left, y: pane.top - whole.top, width: pane.width, height: pane.height };
  }

  // From the mesh, or the plane, to clip coordinates of its pane, column by column.
  matrix(which) {
    const { width, height } = this.box(which), zoom = this.zoom[which], [dx, dy] = this.shift[which];
    const { radius } = which === "space" ? this.frame : this.plane;
    const size = (0.94 * zoom * Math.min(width, height)) / radius, sx = size / width, sy = size / height;
    if (which === "plane") {
      const [cu, cv] = this.plane.center;
      return [sx, 0, 0, 0, 0, sy, 0, 0, 0, 0, 1, 0, dx - sx * cu, dy - sy * cv, 0, 1];
    }
    // A little perspective: the eye is five radii away.
    const t = this.turn, eye = 5 * radius, w = -1 / eye;
    const depth = -0.5 / radius;
    const rows = [
      [sx * t[0] + dx * w * t[6], sx * t[1] + dx * w * t[7], sx * t[2] + dx * w * t[8], dx],
      [sy * t[3] + dy * w * t[6], sy * t[4] + dy * w * t[7], sy * t[5] + dy * w * t[8], dy],
      [depth * t[6], depth * t[7], depth * t[8], 0],
      [w * t[6], w * t[7], w * t[8], 1],
    ];
    return [0, 1, 2, 3].flatMap((column) => rows.map((row) => row[column]));
  }

  // Where a vertex is drawn, in CSS pixels of the canvas, and whether it faces away.
  spot(which, vertex) {
    const m = this.matrix(which), box = this.box(which), p = this._point(which, vertex);
    const [x, y, w] = [0, 1, 3].map((k) => m[k] * p[0] + m[k + 4] * p[1] + m[k + 8] * p[2] + m[k + 12]);
    const n = this.normals, t = this.turn, v = 3 * vertex;
    const away = which === "space" && t[6] * n[v] + t[7] * n[v + 1] + t[8] * n[v + 2] < 0;
    return { x: box.x + (0.5 + (0.5 * x) / w) * box.width, y: box.y + (0.5 - (0.5 * y) / w) * box.height, away };
  }

  _point(which, vertex) {
    if (which === "space") return this.centred.subarray(3 * vertex, 3 * vertex + 3);
    return [this.arrays.uv[2 * vertex], this.arrays.uv[2 * vertex + 1], 0];
  }

  // The vertex nearest to a place in a pane (CSS pixels of the canvas) among those of the triangle there; null beside it.
  pick(which, x, y) {
    const gl = this.gl, box = this.box(which);
    const px = (2 * (x - box.x)) / box.width - 1, py = 1 - (2 * (y - box.y)) / box.height;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.pickTarget);
    gl.viewport(0, 0, 1, 1);
    gl.disable(gl.SCISSOR_TEST);
    gl.disable(gl.BLEND);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    // One pixel is drawn: that under the pointer, made as large as the whole.
    const m = this.matrix(which), out = m.slice();
    for (let column = 0; column < 16; column += 4) {
      out[column] = box.width * (m[column] - px * m[column + 3]);
      out[column + 1] = box.height * (m[column + 1] - py * m[column + 3]);
    }
    this._use(which, out, 0);
    gl.uniform1i(this.places.mode, 1);
    this._elements(this.faceBuffer, gl.TRIANGLES, this.arrays.triangles.length);
    const bytes = new Uint8Array(4);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    const name = bytes[0] + 256 * bytes[1] + 65536 * bytes[2];
    if (name === 0) return null;
    let best = null, least = Infinity;
    for (const vertex of [name - 1, ...this.rings(name - 1)]) {
      const spot = this.spot(which, vertex), far = (spot.x - x) ** 2 + (spot.y - y) ** 2;
      if (far < least) [best, least] = [vertex, far];
    }
    return best;
  }

  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => { this.waiting = false; this._draw(); });
  }

  _draw() {
    const gl = this.gl, ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.round(this.canvas.clientWidth * ratio), height = Math.round(this.canvas.clientHeight * ratio);
    if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
    const style = getComputedStyle(document.documentElement), color = (name) => rgb(style.getPropertyValue(name));
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    gl.enable(gl.SCISSOR_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    for (const which of ["space", "plane"]) {
      const box = this.box(which);
      const corner = [box.x * ratio, height - (box.y + box.height) * ratio, box.width * ratio, box.height * ratio].map(Math.round);
      gl.viewport(...corner);
      gl.scissor(...corner);
      this._use(which, this.matrix(which), 0);
      gl.uniform1i(this.places.mode, this.options.shade ? 3 : 2);
      gl.uniform4f(this.places.plain, 0.83, 0.77, 0.68, 1);
      gl.uniform2f(this.places.reach, ...this.options.reach);
      this._elements(this.faceBuffer, gl.TRIANGLES, this.arrays.triangles.length);
      gl.uniform1i(this.places.mode, 0);
      gl.uniform1f(this.places.nearer, which === "space" ? 2e-4 : 0);
      if (this.options.wires) {
        const ink = [0.08, 0.12, 0.16].map((c) => c * 0.45);
        gl.uniform4f(this.places.plain, ...ink, 0.45);
        this._elements(this.edgeBuffer, gl.LINES, this.edges.length);
      }
      if (this.options.rim) {
        gl.uniform1f(this.places.nearer, which === "space" ? 1e-3 : 0);
        gl.uniform4f(this.places.plain, ...color("--accent"), 1);
        this._elements(this.rimBuffer, gl.LINES, this.rimLength);
      }
    }
    this.drawn?.();
  }

  _use(which, matrix, nearer) {
    const gl = this.gl, t = which === "space" ? this.turn : this.frame.turn;
    gl.useProgram(this.program);
    gl.bindVertexArray(this.mesh);
    gl.uniformMatrix4fv(this.places.view, false, matrix);
    gl.uniformMatrix3fv(this.places.turn, true, t);
    for (const name of ["isPlane", "isFlat"]) gl.uniform1i(this.places[name], which === "plane" ? 1 : 0);
    gl.uniform1f(this.places.nearer, nearer);
    gl.uniform1i(this.places.palette, 0);
    gl.bindTexture(gl.TEXTURE_2D, this.palette);
  }

  _elements(buffer, kind, length) {
    this.gl.bindBuffer(this.gl.ELEMENT_ARRAY_BUFFER, buffer);
    this.gl.drawElements(kind, length, this.gl.UNSIGNED_INT, 0);
  }
}

function linked(gl) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(`the mesh cannot be drawn: ${gl.getProgramInfoLog(program)}`);
  return program;
}

function attribute(gl, place, values, size, kind, normalized) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
  gl.enableVertexAttribArray(place);
  gl.vertexAttribPointer(place, size, kind, normalized, 0, 0);
  return buffer;
}

function indexBuffer(gl, indices) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
  return buffer;
}

function pickTarget(gl) {
  const target = gl.createFramebuffer(), color = gl.createRenderbuffer(), depth = gl.createRenderbuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  for (const [buffer, format, place] of [[color, gl.RGBA8, gl.COLOR_ATTACHMENT0], [depth, gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT]]) {
    gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
    gl.renderbufferStorage(gl.RENDERBUFFER, format, 1, 1);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer);
  }
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  return target;
}

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

// The first view, turned a little to the side. A patch is seen along its mean normal, with z up where that is across the
// view, else y. A surface that closes up to its boundary stands on it, and is seen where it is widest.
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
const rgb = (hex) => [1, 3, 5].map((k) => parseInt(hex.trim().slice(k, k + 2), 16) / 255);

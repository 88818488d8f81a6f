// Both views of the mesh in one WebGL canvas: in space, turned by the user, and in the parameter plane.

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
      gl.uniform4f(this.places.plain, ...content.stone, 1);
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

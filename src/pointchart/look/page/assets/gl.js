// The shaders, and what WebGL needs of buffers and targets.

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

const rgb = (hex) => [1, 3, 5].map((k) => parseInt(hex.trim().slice(k, k + 2), 16) / 255);

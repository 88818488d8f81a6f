// The page: what is told of the run, and the hands on both views.

const $ = (id) => document.getElementById(id);
const SEQUENTIAL = ["#f6ead2", "#c9d6a3", "#61a5a9", "#2a6f97", "#1d3557"];
const DIVERGING = ["#12344f", "#2a6f97", "#8fbcd4", "#f4efe4", "#eba98f", "#c8553d", "#7a2416"];
const THEMES = ["light", "dark"];
const run = content.run, proof = run.certificate;

const whole = (x) => x.toLocaleString("en");
function digits(x) {
  if (x === null || !Number.isFinite(x)) return "∞";
  const size = Math.abs(x);
  return (size !== 0 && (size < 1e-3 || size >= 1e6) ? x.toExponential(2) : String(Number(x.toPrecision(4)))).replaceAll("-", "−");
}

function made(name, fields = {}, ...children) {
  const element = Object.assign(document.createElement(name), fields);
  element.append(...children);
  return element;
}

function table(rows) {
  return made("table", {}, ...rows.map((row) => made("tr", {}, ...row.map((cell) => (cell instanceof Node ? cell : made("td", { textContent: cell }))))));
}

function bars(counts, label, color = null) {
  const most = Math.max(...counts, 1), svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  for (const [key, value] of Object.entries({ class: "bars", role: "img", "aria-label": label })) svg.setAttribute(key, value);
  svg.setAttribute("viewBox", `0 0 ${counts.length} 100`);
  svg.setAttribute("preserveAspectRatio", "none");
  counts.forEach((count, k) => {
    const bar = document.createElementNS(svg.namespaceURI, "rect"), height = count ? Math.max((100 * count) / most, 1.5) : 0;
    for (const [key, value] of Object.entries({ x: k + 0.06, y: 100 - height, width: 0.88, height })) bar.setAttribute(key, value);
    if (color) bar.style.fill = color(k / (counts.length - 1));
    svg.append(bar);
  });
  return svg;
}

const ends = (...texts) => made("div", { className: "ends" }, ...texts.map((textContent) => made("span", { textContent })));

function tell() {
  $("summary").textContent = `${whole(proof.points)} points, ${whole(proof.triangles)} triangles, boundary of ${whole(run.boundary.points)} points`;
  const holes = ["", " with a hole"][proof.holes] ?? ` with ${proof.holes} holes`, disc = `certified disc${holes}`;
  const isOneToOne = proof.as_asked && proof.uv_distinct && proof.uv_positive && proof.uv_boundary_simple;
  $("verdict").textContent = (proof.as_asked ? disc : "no disc") + (isOneToOne ? ", uv one-to-one" : ", uv not one-to-one");
  $("verdict").classList.toggle("failed", !isOneToOne);
  $("checks").append(...content.checks.map((check) => made("li", { textContent: check.text, className: check.measured ? "measured" : check.passed ? "passed" : "failed" })));
  const all = run.stages.reduce((sum, stage) => sum + stage.seconds, 0), longest = Math.max(...run.stages.map((stage) => stage.seconds));
  const rows = run.stages.map((stage) => {
    const meter = made("i");
    meter.style.width = `${(100 * stage.seconds) / longest}%`;
    return [stage.name, made("td", { className: "meter" }, meter), `${stage.seconds.toFixed(2)} s`];
  });
  $("stages").append(table([...rows, ["all", "", `${all.toFixed(2)} s`]]));
  const gaps = run.boundary.gaps;
  $("boundary").append(table([
    ["origin", run.boundary.origin],
    ["points", whole(run.boundary.points)],
    ["length", digits(run.boundary.length)],
    ["loops that were found", whole(run.boundary.loops.length)],
    ["gaps of the scan", gaps.length ? `${gaps.length}, ${proof.holes} left open` : "none"],
    ["points repeated", whole(run.points.repeated)],
    ["points left out", whole(run.points.left_out)],
  ]));
  const places = content.places.filter((place) => place.is_doubt).length;
  Object.assign($("doubts"), { hidden: places === 0, textContent: places === 1 ? "1 place to look at" : `${places} places to look at` });
  $("histograms").append(...content.histograms.map((h) => made("figure", {}, made("figcaption", { textContent: h.title }, made("small", { textContent: h.meaning })), bars(h.counts, `${h.title}, from ${digits(h.low)} to ${digits(h.high)}`), ends(digits(h.low), digits(h.high)))));
  const q = run.quality, solve = run.solve_uv;
  $("quality").append(table([
    ["shape of triangles: least, median", `${digits(q.radius_ratio.least)}, ${digits(q.radius_ratio.median)}`],
    ["longest edge, in spacings", digits(proof.longest_edge_over_spacing)],
    ["folds", whole(proof.folds)],
    ["places where the mesh passes through itself", whole(q.self_intersections.count)],
    ["L2 stretch, L∞ stretch", `${digits(q.l2_stretch)}, ${digits(q.linf_stretch)}`],
    ["conformal distortion: mean, 95 %", `${digits(q.conformal.mean)}, ${digits(q.conformal.percentile_95)}`],
    ["least distance in the plane", digits(q.least_uv_distance)],
    ["edge swaps", whole(run.swaps.count)],
    ["points relocated", whole(run.swaps.relocated_points)],
    ["solve of uv", `${solve.method}, residual ${digits(solve.residual)}`],
  ]));
  if (run.surface) tellOfSurface(run.surface);
  $("command").textContent = content.command;
  $("made").textContent = content.made_with;
  $("options").append(table(Object.entries(run.options).filter(([, value]) => value !== null).map(([name, value]) => [name, String(value)])));
  const all_points = proof.points;
  $("drawn").textContent = content.drawn < all_points ? `${whole(content.drawn)} of ${whole(all_points)} points are drawn, so that the page turns smoothly; all numbers are of all points.` : "";
}

function tellOfSurface(surface) {
  $("surface").hidden = false;
  const off = surface.deviation, length = (x) => `${digits(x)} ${surface.unit}`;
  const isMet = surface.met ? "met" : "not met";
  $("fit").append(table([
    ["B-spline surface of degree", String(surface.degree)],
    ["control points", surface.control_points.join(" × ")],
    ["points a control point", digits(surface.points_a_control_point)],
    ["trimmed by", surface.trimming_loops.length > 1 ? `its boundary and ${surface.trimming_loops.length - 1} gaps` : "its boundary"],
    [`tolerance, but for ${digits(100 * surface.outliers)} %`, `${length(surface.tolerance)}, ${isMet}`],
    ["largest deviation", length(off.max)],
    [`the same but for ${digits(100 * surface.outliers)} %`, length(off.max_but_outliers)],
    ["95 %", length(off.percentile_95)],
    ["RMS, mean", `${length(off.rms)}, ${length(off.mean)}`],
    ["points within the tolerance", `${digits(100 * off.share_within_tolerance)} %`],
  ]));
}

function colorsOf(shade) {
  const stops = (shade.is_signed ? DIVERGING : SEQUENTIAL).map(rgb), colors = new Uint8Array(4 * 256);
  for (let k = 0; k < 256; k++) {
    const place = (k / 255) * (stops.length - 1), at = Math.min(Math.floor(place), stops.length - 2), t = place - at;
    for (let c = 0; c < 3; c++) colors[4 * k + c] = Math.round(255 * ((1 - t) * stops[at][c] + t * stops[at + 1][c]));
    colors[4 * k + 3] = 255;
  }
  return colors;
}

// Numbers to a step: with so many digits that steps are told apart, and no more.
function fine(numbers, step) {
  const places = Math.max(0, Math.ceil(-Math.log10(step || 1)));
  return numbers.map((x) => (places > 12 ? x.toExponential(5) : x.toFixed(places))).join("  ");
}

const css = (colors, share) => `rgb(${[0, 1, 2].map((c) => colors[4 * Math.round(255 * share) + c]).join(" ")})`;
const shown = (shade, placed) => digits(shade.is_log ? Math.exp(placed) : placed);

function show(scene, arrays, name) {
  const shade = content.shades.find((row) => row.name === name);
  $("shade").value = name;
  $("legend").replaceChildren();
  if (!shade) return scene.setShade(null, [0, 1], null);
  const colors = colorsOf(shade), [low, high] = shade.range, extent = high - low || 1;
  scene.setShade(arrays[name], shade.reach.map((x) => (x - low) / extent), colors);
  const ramp = made("div", { className: "ramp" });
  ramp.style.background = `linear-gradient(to right, ${[0, 0.25, 0.5, 0.75, 1].map((t) => css(colors, t)).join(", ")})`;
  const [first, last] = shade.reach;
  $("legend").append(bars(shade.counts, `points by ${shade.name}`, (share) => css(colors, share)), ramp, ends(shown(shade, first), shown(shade, (first + last) / 2), shown(shade, last)), made("small", { className: "quiet", textContent: shade.meaning }));
}

function light(scene, arrays, vertex) {
  for (const which of ["space", "plane"]) {
    const mark = $(`mark-${which}`);
    mark.classList.toggle("lit", vertex !== null);
    if (vertex === null) continue;
    const spot = scene.spot(which, vertex), box = scene.box(which);
    const isInside = spot.x >= box.x && spot.x <= box.x + box.width && spot.y >= box.y && spot.y <= box.y + box.height;
    mark.classList.toggle("lit", isInside);
    mark.classList.toggle("behind", spot.away);
    mark.setAttribute("cx", spot.x);
    mark.setAttribute("cy", spot.y);
  }
  const readout = $("readout");
  if (readout.dataset.vertex === String(vertex === null ? "" : arrays.row[vertex])) return;
  readout.dataset.vertex = vertex === null ? "" : arrays.row[vertex];
  if (vertex === null) return void (readout.textContent = "Point at the mesh or the plane: the same point lights up in both.");
  const { low, extent } = content.box, place = [0, 1, 2].map((d) => low[d] + (extent * arrays.position[3 * vertex + d]) / 65535);
  const uv = [0, 1].map((d) => arrays.uv[2 * vertex + d]);
  const parts = [["point", String(arrays.row[vertex])], ["x y z", fine(place, extent / 3e4)], ["u v", fine(uv, scene.plane.radius / 1e6)]];
  for (const shade of content.shades) {
    const [first, last] = shade.range;
    parts.push([shade.name, shown(shade, first + ((last - first) * arrays[shade.name][vertex]) / 65535)]);
  }
  readout.replaceChildren(...parts.map(([name, value]) => made("span", {}, `${name} `, made("b", { textContent: value.replaceAll("-", "−") }))));
}

// The command for a figure that looks the same way: its angles go around the axis upwards, and none leans aside.
function tellFigure(turn) {
  const towards = turn.slice(6, 9), [x, y, z] = [0, 3, 6].map((k) => dot(content.upright.slice(k, k + 3), towards));
  const angles = [Math.atan2(x, z), Math.asin(Math.min(Math.max(y, -1), 1))].map((angle) => Math.round((angle * 180) / Math.PI));
  $("figure").hidden = content.figure === null;
  $("figure").lastElementChild.textContent = `${content.figure} --view=${angles.join(",")} --up ${content.up}`;
}

function nearestTo(arrays, place) {
  const { low, extent } = content.box, at = place.map((x, d) => ((x - low[d]) / (extent || 1)) * 65535);
  let best = 0, least = Infinity;
  for (let v = 0; v < arrays.position.length / 3; v++) {
    const far = at.reduce((sum, x, d) => sum + (x - arrays.position[3 * v + d]) ** 2, 0);
    if (far < least) [best, least] = [v, far];
  }
  return best;
}

function handle(scene, arrays) {
  const stage = $("stage"), touches = new Map();
  let lit = null, isHeld = false, last = null, moved = 0, before = null;
  scene.drawn = () => { light(scene, arrays, lit); tellFigure(scene.turn); };
  $("places").append(...content.places.map((place) => {
    const button = made("button", { type: "button", textContent: place.what, className: place.is_doubt ? "doubt" : "" });
    button.addEventListener("click", () => {
      [lit, isHeld] = [nearestTo(arrays, place.at), true];
      scene.visit(lit);
      stage.scrollIntoView({ block: "nearest" });
    });
    return made("li", {}, button);
  }));
  const paneAt = (event) => {
    const whole = stage.getBoundingClientRect(), x = event.clientX - whole.left, y = event.clientY - whole.top;
    const which = ["space", "plane"].find((name) => { const b = scene.box(name); return x >= b.x && x < b.x + b.width && y >= b.y && y < b.y + b.height; });
    return { which, x, y };
  };
  const zoomBy = (which, factor, x, y) => {
    const box = scene.box(which), at = [(2 * (x - box.x)) / box.width - 1, 1 - (2 * (y - box.y)) / box.height];
    const before = scene.zoom[which];
    scene.zoom[which] = Math.min(Math.max(before * factor, 0.3), 1e6);
    const real = scene.zoom[which] / before;
    scene.shift[which] = scene.shift[which].map((s, d) => at[d] + real * (s - at[d]));
    scene.draw();
  };
  const middle = () => {
    const places = [...touches.values()], x = places.reduce((sum, p) => sum + p.x, 0) / places.length, y = places.reduce((sum, p) => sum + p.y, 0) / places.length;
    return { x, y, span: places.length > 1 ? Math.hypot(places[0].x - places[1].x, places[0].y - places[1].y) : 0 };
  };
  stage.addEventListener("pointerdown", (event) => {
    const at = paneAt(event);
    if (!at.which) return;
    if (touches.size === 0) [stage.dataset.pane, moved, before] = [at.which, 0, [scene.turn, { ...scene.shift }]];
    touches.set(event.pointerId, at);
    stage.setPointerCapture(event.pointerId);
    stage.focus({ preventScroll: true });
    last = middle();
  });
  stage.addEventListener("pointermove", (event) => {
    const at = paneAt(event);
    if (!touches.has(event.pointerId)) {
      if (isHeld || !at.which || event.pointerType === "touch") return;
      const vertex = scene.pick(at.which, at.x, at.y);
      if (vertex !== lit) light(scene, arrays, (lit = vertex));
      return;
    }
    touches.set(event.pointerId, at);
    const now = middle(), which = stage.dataset.pane, dx = now.x - last.x, dy = now.y - last.y, box = scene.box(which);
    moved += Math.abs(dx) + Math.abs(dy);
    if (which === "space" && touches.size === 1 && !event.shiftKey && event.buttons !== 2) {
      scene.turn = turned(scene.turn, dx * 0.008, dy * 0.008);
    } else {
      scene.shift[which] = [scene.shift[which][0] + (2 * dx) / box.width, scene.shift[which][1] - (2 * dy) / box.height];
    }
    if (now.span && last.span) zoomBy(which, now.span / last.span, now.x, now.y);
    last = now;
    scene.draw();
  });
  const release = (event) => {
    const at = touches.get(event.pointerId);
    touches.delete(event.pointerId);
    if (touches.size) last = middle();
    if (event.type === "pointercancel") {
      // The browser scrolls with this finger: what it has turned so far was not meant.
      [scene.turn, scene.shift] = before;
      scene.draw();
    }
    if (event.type !== "pointerup" || !at || moved > 4) return;
    lit = scene.pick(at.which, at.x, at.y);
    isHeld = lit !== null;
    light(scene, arrays, lit);
  };
  for (const kind of ["pointerup", "pointercancel"]) stage.addEventListener(kind, release);
  // Keys follow the pointer, unless something else has them.
  stage.addEventListener("pointerenter", () => { if (document.activeElement === document.body) stage.focus({ preventScroll: true }); });
  stage.addEventListener("pointerleave", () => { if (!isHeld && !touches.size) light(scene, arrays, (lit = null)); });
  stage.addEventListener("contextmenu", (event) => event.preventDefault());
  stage.addEventListener("wheel", (event) => {
    const at = paneAt(event);
    if (!at.which) return;
    event.preventDefault();
    zoomBy(at.which, Math.exp(-event.deltaY * (event.deltaMode ? 0.03 : 0.0015)), at.x, at.y);
  }, { passive: false });
  const names = [...$("shade").options].map((option) => option.value);
  const turnBy = (across, down) => () => { scene.turn = turned(scene.turn, across, down); scene.draw(); };
  const zoomBoth = (factor) => () => { for (const which of ["space", "plane"]) { const b = scene.box(which); zoomBy(which, factor, b.x + b.width / 2, b.y + b.height / 2); } };
  const keys = {
    ArrowLeft: turnBy(-0.1, 0), ArrowRight: turnBy(0.1, 0), ArrowUp: turnBy(0, -0.1), ArrowDown: turnBy(0, 0.1),
    "+": zoomBoth(1.2), "=": zoomBoth(1.2), "-": zoomBoth(1 / 1.2),
    e: () => $("wires").click(), b: () => $("rim").click(), r: () => $("reset").click(), t: () => $("theme").click(), "?": () => $("keys").click(),
    Escape: () => { isHeld = false; light(scene, arrays, (lit = null)); },
  };
  names.forEach((name, k) => { keys[k + 1] = () => show(scene, arrays, name); });
  $("views").addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return;
    const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
  $("shade").addEventListener("change", () => show(scene, arrays, $("shade").value));
  for (const [id, option] of [["wires", "wires"], ["rim", "rim"]]) {
    $(id).addEventListener("change", () => { scene.options[option] = $(id).checked; scene.draw(); });
  }
  $("reset").addEventListener("click", () => scene.reset());
  new ResizeObserver(() => scene.draw()).observe(stage);
}

function theme() {
  const wish = matchMedia("(prefers-color-scheme: dark)"), root = document.documentElement;
  root.dataset.theme = THEMES[Number(wish.matches)];
  wish.addEventListener("change", () => { root.dataset.theme = THEMES[Number(wish.matches)]; window.scene?.draw(); });
  $("theme").addEventListener("click", () => { root.dataset.theme = THEMES[Number(root.dataset.theme === "light")]; window.scene?.draw(); });
  $("keys").addEventListener("click", () => { $("help").hidden = !$("help").hidden; $("keys").setAttribute("aria-expanded", String(!$("help").hidden)); });
}

async function begin() {
  theme();
  tell();
  $("shade").append(...["plain", ...content.shades.map((shade) => shade.name)].map((name) => made("option", { value: name, textContent: name })));
  try {
    if (!("DecompressionStream" in window)) throw new Error("this browser is too old to unpack the mesh; all else on this page is here");
    const arrays = await unpack();
    window.scene = new Scene($("canvas"), { space: $("space"), plane: $("plane") }, arrays, content.turn);
    handle(window.scene, arrays);
    show(window.scene, arrays, run.surface ? "deviation" : "plain");
    document.body.dataset.ready = "yes";
  } catch (error) {
    Object.assign($("trouble"), { hidden: false, textContent: error.message });
    throw error;
  }
}

begin();

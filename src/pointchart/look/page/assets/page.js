// The hands on both views, and the beginning.

const THEMES = ["light", "dark"];
const HINT = $("readout").textContent;

function colorsOf(shade) {
  const stops = shade.colors.map(rgb), colors = new Uint8Array(4 * 256);
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
  if (vertex === null) return void (readout.textContent = HINT);
  const { low, extent } = content.box, place = [0, 1, 2].map((d) => low[d] + (extent * arrays.position[3 * vertex + d]) / 65535);
  const uv = [0, 1].map((d) => arrays.uv[2 * vertex + d]);
  const parts = [["point", String(arrays.row[vertex])], ["x y z", fine(place, extent / 3e4)], ["u v", fine(uv, scene.plane.radius / 1e6)]];
  for (const shade of content.shades) {
    const [first, last] = shade.range;
    parts.push([shade.name, shown(shade, first + ((last - first) * arrays[shade.name][vertex]) / 65535)]);
  }
  readout.replaceChildren(...parts.map(([name, value]) => made("span", {}, `${name} `, made("b", { textContent: value.replaceAll("-", "−") }))));
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
    if (touches.size === 0) [stage.dataset.pane, moved, before] = [at.which, 0, [scene.turn, { ...scene.shift }, { ...scene.zoom }]];
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
    if (at && event.type === "pointercancel") {
      // The browser scrolls with this finger: what it has turned so far was not meant.
      [scene.turn, scene.shift, scene.zoom] = before;
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

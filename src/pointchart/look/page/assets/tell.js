// What the page says of the run in words, numbers and bars.

const $ = (id) => document.getElementById(id);
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
  const isOfUV = proof.uv_distinct !== null, isFailed = isOfUV ? !isOneToOne : !proof.as_asked;
  const ofUV = isOfUV ? (isOneToOne ? ", uv one-to-one" : ", uv not one-to-one") : "";
  $("verdict").textContent = (proof.as_asked ? disc : "no disc") + ofUV;
  $("verdict").classList.toggle("failed", isFailed);
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

// The command for a figure from the same side: its angles go around the axis upwards, and it never leans aside.
function tellFigure(turn) {
  $("figure").hidden = content.figure === null;
  if (content.figure === null) return;
  const towards = turn.slice(6, 9), [x, y, z] = [0, 3, 6].map((k) => dot(content.upright.slice(k, k + 3), towards));
  const angles = [Math.atan2(x, z), Math.asin(Math.min(Math.max(y, -1), 1))].map((angle) => Math.round((angle * 180) / Math.PI));
  $("figure").lastElementChild.textContent = `${content.figure} --view=${angles.join(",")} --up ${content.up}`;
}

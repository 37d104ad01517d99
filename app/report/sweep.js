// The report of a sweep: what was varied, what it did to each response, and what failed.

const MOST_PLOTS = 12;

function shortName(name) {
  return name.replace(/^design\./, "");
}

function valuesWords(factor) {
  if (factor.range) return `${neat(factor.range[0])} to ${neat(factor.range[1])}`;
  if (factor.normal) return `normal, mean ${neat(factor.normal.mean)}, sd ${neat(factor.normal.sd)}`;
  const values = factor.values ?? [];
  return values.length > 8 ?
      `${values.length} values, ${neat(values[0])} to ${neat(values[values.length - 1])}` :
      values.map(neat).join(", ");
}

function verdictBox(data) {
  const {counts} = data, bad = data.samples - counts.ok;
  const title = bad === 0 ? `All ${data.samples} samples were computed` :
                            `${bad} of ${data.samples} samples did not succeed`;
  const text = `Model ${data.model}, ${words(data.method)}, ${
                   count(data.factors.length, "factor", "factors")}, seed ${data.seed}.` +
      (bad > 0 ?
           ` ${counts.missed} missed, ${counts.disagrees} disagree, ${counts.failed} failed: listed below.` :
           "");
  return html(
      "div", {class: "verdict " + (bad === 0 ? "good" : "unsure")},
      html("div", {class: "mark"}, bad === 0 ? "\u2713" : "!"),
      html("div", {}, html("h2", {}, title), html("p", {}, text)));
}

function factorTable(data) {
  return html(
      "div", {class: "scroll"},
      table(["factor", "values"], data.factors.map((f) => ({cells: [f.name, valuesWords(f)]})), "factors"));
}

/** How much each factor matters for a response: [{label, value, low, high}], and what the numbers are. */
function importance(response) {
  const bars = (list, get) =>
      list.map((entry, k) => ({k, value: get(entry)[0], low: get(entry)[1], high: get(entry)[2]}));
  if (response.sobol)
    return {
      what: "Sobol's total index, share of the variance",
      bars: bars(response.sobol, (s) => s.total),
      second: bars(response.sobol, (s) => s.first),
      names: ["total", "by itself"]
    };
  if (response.morris)
    return {
      what: "mean absolute elementary effect",
      bars: bars(response.morris, (m) => m.mu_star),
      second: bars(response.morris, (m) => m.sigma),
      names: ["mean absolute effect", "standard deviation"]
    };
  const effects = response.main_effects ?? [];
  if (effects.every((e) => finite(e.variance_share) === null)) {
    const span = (e) => {
      const means = e.levels.map((l) => l.mean).filter((m) => finite(m) !== null);
      return [means.length ? Math.max(...means) - Math.min(...means) : null, null, null];
    };
    return {what: "largest change of the mean", bars: bars(effects, span)};
  }
  return {
    what: "share of the variance that goes with the factor alone",
    bars: bars(effects, (e) => [e.variance_share, null, null])
  };
}

function byImportance(response, factors) {
  const {bars} = importance(response);
  return factors.map((_, k) => k).sort((a, b) => (bars[b]?.value ?? -1) - (bars[a]?.value ?? -1));
}

function whisker(axes, y, bar) {
  if (finite(bar.low) === null || finite(bar.high) === null) return null;
  return svg("path", {class: "turn-limit", d: path([[axes.X(bar.low), y], [axes.X(bar.high), y]])});
}

function drawImportance(data, response, width) {
  const {what, bars, second} = importance(response);
  const order = byImportance(response, data.factors).slice(0, 20);
  const all =
      [...bars, ...(second ?? [])].flatMap((b) => [b.value, b.low, b.high]).filter((v) => finite(v) !== null);
  const range = [Math.min(0, ...all), Math.max(...all, 1e-12) * 1.05];
  const step = second ? 34 : 24, height = 72 + step * order.length, left = Math.min(230, width * 0.4);
  const axes = plot({
    width,
    height,
    left,
    label: `${what}, by factor`,
    x: {range, label: what},
    y: {range: [0, 1], label: "", ticks: []}
  });
  order.forEach((k, row) => {
    const top = 30 + step * row,
          draw = (bar, y, thick, kind) => bar && finite(bar.value) !== null ?
        [
          svg("rect", {
            class: kind,
            x: Math.min(axes.X(0), axes.X(bar.value)),
            y,
            height: thick,
            width: Math.max(Math.abs(axes.X(bar.value) - axes.X(0)), 0.5)
          }),
          whisker(axes, y + thick / 2, bar)
        ] :
        [];
    const name = shortName(data.factors[k].name);
    axes.root.append(
        svg("text", {x: left - 8, y: top + step / 2, "text-anchor": "end"},
            name.length > 30 ? name.slice(0, 29) + "\u2026" : name),
        ...draw(bars[k], top + 2, second ? 12 : 15, "turn").filter(Boolean),
        ...draw(second?.[k], top + 16, 9, "second").filter(Boolean));
  });
  return axes.root;
}

function levelX(level) {
  return (level.range[0] + level.range[1]) / 2;
}

/** Samples as dots, the mean level by level as a line with two standard errors. */
function drawEffect(data, r, k, width) {
  const response = data.responses[r],
        levels = (response.main_effects?.[k]?.levels ?? []).filter((l) => finite(l.mean) !== null);
  const dots = (data.scatter ?? [])
                   .map((row) => [row[k], row[data.factors.length + r]])
                   .filter(([, y]) => finite(y) !== null);
  const xs = [...dots.map(([x]) => x), ...levels.flatMap((l) => l.range)],
        ys = [...dots.map(([, y]) => y), ...levels.map((l) => l.mean)];
  if (xs.length === 0) return missing("No sample has this response.");
  const range = (values) =>
      values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
  const axes = plot({
    width,
    height: 230,
    left: 70,
    label: `${response.name} over ${data.factors[k].name}`,
    x: {range: padded(range(xs), 0.03), label: shortName(data.factors[k].name)},
    y: {range: padded(range(ys)), label: response.name}
  });
  axes.root.append(
      svg("g", {class: "cloud"},
          dots.map(([x, y]) => svg("circle", {cx: axes.X(x).toFixed(1), cy: axes.Y(y).toFixed(1), r: 1.6}))),
      svg("path", {class: "model", d: path(levels.map((l) => [axes.X(levelX(l)), axes.Y(l.mean)]))}),
      ...levels.map((l) => svg("circle", {class: "step", cx: axes.X(levelX(l)), cy: axes.Y(l.mean), r: 3})),
      ...levels.filter((l) => finite(l.error) !== null)
          .map((l) => svg("path", {
                 class: "turn-limit",
                 d: path([
                   [axes.X(levelX(l)), axes.Y(l.mean - 2 * l.error)],
                   [axes.X(levelX(l)), axes.Y(l.mean + 2 * l.error)]
                 ])
               })));
  return axes.root;
}

function spreadTable(data) {
  const heads = ["response", "mean", "sd", "least", "5 %", "median", "95 %", "most", "samples"];
  const rows = data.responses.map(
      ({name, spread: s}) => ({
        cells: [
          name, ...["mean", "sd", "least", "p05", "median", "p95", "most"].map((key) => figures(s[key], 4)),
          String(s.count ?? 0)
        ]
      }));
  return html("div", {class: "scroll"}, table(heads, rows, "spread of the responses"));
}

function linearTable(data, response) {
  if (!response.linear || finite(response.linear.r_squared) === null) return null;
  const order = byImportance(response, data.factors).slice(0, 20);
  const rows = order.map((k) => {
    const e = response.linear.factors[k];
    return {
      cells: [
        data.factors[k].name, `${figures(e.slope)} \u00b1 ${figures(e.slope_error, 2)}`,
        figures(e.standardised), figures(e.correlation), figures(e.rank_correlation)
      ]
    };
  });
  return html(
      "div", {class: "scroll"},
      html(
          "p", {class: "note"},
          `A plane through all samples explains ${percent(response.linear.r_squared)} of the variance.`),
      table(["factor", "slope", "standardised", "correlation", "of ranks"], rows, "linear regression"));
}

function responseSection(data, r) {
  const response = data.responses[r], {what, names} = importance(response);
  const shown = byImportance(response, data.factors).slice(0, MOST_PLOTS),
        left = data.factors.length - shown.length;
  const several = data.factors.length > 1;
  return [
    several ? html(
                  "p", {class: "note"},
                  `Bars: ${what}${
                      names ? `; thin: ${names[1]}` :
                              ""}. Lines at their ends: 95 % intervals, where there are any.`) :
                              null,
    several ? responsive((width) => drawImportance(data, response, width)) : null,
    html(
        "p", {class: "note"},
        "Dots: samples. Line: mean at each level of the factor, all else left to vary, with two standard errors." +
            (left > 0 ?
                 ` The ${MOST_PLOTS} factors that matter most are shown; ${left} more are in the table.` :
                 "")),
    html(
        "div", {class: several ? "groups" : ""},
        shown.map((k) => responsive((width) => drawEffect(data, r, k, width)))),
    linearTable(data, response)
  ];
}

function failureSection(data) {
  const rows = data.failures.map((f) => ({cells: [String(f.sample), f.status, f.reason]}));
  const bad = data.samples - data.counts.ok;
  return [
    bad > rows.length ?
        html("p", {class: "note"}, `The first ${rows.length} of ${bad}; all are in samples.csv.`) :
        null,
    html("div", {class: "scroll"}, table(["sample", "status", "reason"], rows, "failures"))
  ];
}

function provenanceSection(data) {
  const facts = [
    ["program", `kinetix ${data.kinetix_version}`], ["seed", String(data.seed)],
    ["sweep file", data.doe_sha256], ["base file", data.base_sha256], ["all files", data.files_sha256]
  ];
  return [
    html(
        "dl", {class: "facts"},
        facts.map(([name, text]) => html("div", {}, html("dt", {}, name), html("dd", {}, text)))),
    html("pre", {class: "scroll"}, data.doe ?? "")
  ];
}

function section(id, title, content) {
  return html("section", {id}, html("h2", {}, title), content ?? missing("This part could not be made."));
}

function build(data) {
  document.title = `${data.name} \u2013 KinetiX sweep`;
  const page = document.getElementById("report");
  page.append(html(
      "header", {id: "headline"}, html("p", {class: "eyebrow"}, "KinetiX sweep"), html("h1", {}, data.name),
      verdictBox(data)));
  page.append(section("factors", "What was varied", guarded(() => factorTable(data))));
  if (data.not_analysed) page.append(section("responses", "Responses", missing(data.not_analysed)));
  if (data.responses.length)
    page.append(section("responses", "Results", guarded(() => spreadTable(data))));
  data.responses.forEach(
      (response, r) =>
          page.append(section(`response-${r}`, response.name, guarded(() => responseSection(data, r)))));
  if (data.failures.length)
    page.append(section("failures", "Samples that did not succeed", guarded(() => failureSection(data))));
  page.append(section("provenance", "Provenance", guarded(() => provenanceSection(data))));
  drawAll();
}

function prepareForPaper(printing) {
  if (printing)
    document.documentElement.dataset.theme = "light";
  else
    delete document.documentElement.dataset.theme;
  drawAll(true, printing ? 330 : 0);
}

function start() {
  window.addEventListener("error", (event) => problem(`Error in this page: ${event.message}`));
  const raw = guarded(() => JSON.parse(document.getElementById("result").textContent));
  if (raw) guarded(() => build(raw));
  window.addEventListener("resize", () => drawAll());
  window.addEventListener("beforeprint", () => prepareForPaper(true));
  window.addEventListener("afterprint", () => prepareForPaper(false));
  document.documentElement.dataset.ready = "true";
}

start();

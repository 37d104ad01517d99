// Plots of a sweep: the distribution of a response, and the effect of factors on it, also on the flat sheet.

/** Draws the histogram of a response, with its median and the limits of most samples. */
function drawSpread(response, width) {
  const {words: said, unit} = named(response.name), {spread: s, histogram: bars} = response, {from, to} = within(response);
  const range = padded([s.least, s.most], 0.02), most = Math.max(...bars);
  const axes = plot({
    width,
    height: 190,
    left: 44,
    label: `How often ${said} has which value`,
    x: {range, label: unit ? `${said}, ${unit}` : said},
    y: {range: [0, most * 1.05], label: `of ${count(s.count, "sample", "samples")}`}
  });
  const step = (s.most - s.least) / bars.length;
  axes.root.append(
      svg("g", {}, bars.map((n, k) => svg("rect", {
            class: "turn",
            x: axes.X(s.least + k * step) + 1,
            width: Math.max(axes.X(s.least + step) - axes.X(s.least) - 2, 1),
            y: axes.Y(n),
            height: axes.Y(0) - axes.Y(n)
          }))),
      ...[from, s.median, to].map(
          (v) => svg("path", {class: "turn-limit", d: path([[axes.X(v), axes.Y(0)], [axes.X(v), axes.area.top]])})));
  return axes.root;
}

/** Returns the importance of each factor: bars [{value, low, high}], second bars if there are any, and their names. */
function importance(response) {
  const bars = (list, get) => list.map((entry) => ({value: get(entry)[0], low: get(entry)[1], high: get(entry)[2]}));
  if (response.sobol)
    return {
      what: "Sobol's total index, share of the variance",
      bars: bars(response.sobol, (s) => s.total.map(clampedShare)),
      second: bars(response.sobol, (s) => s.first.map(clampedShare)),
      names: ["total", "alone"]
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
      const means = (e.levels ?? []).map((l) => l.mean).filter((m) => finite(m) !== null);
      return [means.length ? Math.max(...means) - Math.min(...means) : null, null, null];
    };
    return {what: "largest change of the mean", bars: bars(effects, span)};
  }
  return {
    what: "share of the variance that goes with the factor alone",
    bars: bars(effects, (e) => [clampedShare(e.variance_share), ...(e.variance_interval ?? [null, null])])
  };
}

function whisker(axes, y, bar) {
  if (finite(bar.low) === null || finite(bar.high) === null) return null;
  return svg("path", {class: "turn-limit", d: path([[axes.X(bar.low), y], [axes.X(bar.high), y]])});
}

/** Draws horizontal bars. @param rows [{words, bar, second}] */
function drawBars(rows, what, width) {
  const all = rows.flatMap(({bar, second}) => [bar, second].flatMap((b) => [b?.value, b?.low, b?.high]))
                  .filter((v) => finite(v) !== null);
  const range = [Math.min(0, ...all), Math.max(...all, 1e-12) * 1.05], twice = rows.some(({second}) => second);
  const step = twice ? 34 : 26, left = Math.min(250, width * 0.42);
  const axes = plot({
    width,
    height: 72 + step * rows.length,
    left,
    label: `${what}, by factor`,
    x: {range, label: what},
    y: {range: [0, 1], label: "", ticks: []}
  });
  const draw = (bar, y, thick, kind) => bar && finite(bar.value) !== null ?
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
  rows.forEach(({words: said, bar, second}, row) => {
    const top = 30 + step * row, most = Math.floor(left / 7.5);
    axes.root.append(
        svg("text", {x: left - 8, y: top + step / 2, "text-anchor": "end"},
            said.length > most ? said.slice(0, most - 1) + "\u2026" : said),
        ...draw(bar, top + 2, twice ? 12 : 16, "turn").filter(Boolean),
        ...draw(second, top + 16, 9, "second").filter(Boolean));
  });
  return axes.root;
}

/** Draws a bar for each family if families have shares, else for each plotted factor. */
function drawImportance(data, response, width) {
  const {what, bars, second} = importance(response), shares = response.families ?? [];
  if (data.families.length < data.factors.length && shares.some(Boolean)) {
    const rows = data.families.map(({name, factors}, f) => ({
                                     words: factorNamed(name).words + (factors.length > 1 ? ` (${factors.length})` : ""),
                                     bar: {value: clampedShare(shares[f]?.[0]), low: clampedShare(shares[f]?.[1]), high: clampedShare(shares[f]?.[2])}
                                   }));
    return drawBars(rows, "share of the variance", width);
  }
  return drawBars(
      response.plotted.map((k) => ({words: factorNamed(data.factors[k].name).words, bar: bars[k], second: second?.[k]})),
      what, width);
}

/** Returns whether a sheet is too long for two of them side by side. */
function isLong(layout) {
  const span = (values) => Math.max(...values) - Math.min(...values);
  return span(layout.walls_mm.flatMap(([a, , c]) => [a, c])) > 6 * span(layout.walls_mm.flatMap(([, b, , d]) => [b, d]));
}

/** Returns the families with one factor per wall of the layout: [{name, walls: [[wall, factor], ...]}]. */
function familiesOnWalls(data) {
  const walls = data.layout?.walls_mm.length ?? 0;
  return data.families.map(({name, factors}) => ({
                             name,
                             walls: factors.map((f) => [Number(/^design\.walls\[(\d+)\]/.exec(data.factors[f].name)?.[1] ?? NaN), f])
                           }))
      .filter(({walls: list}) => list.length > 1 && list.every(([wall]) => wall < walls));
}

/** Returns the effect of each wall's factor on a response: [[wall, value], ...]. */
function sensitivities(response, family) {
  const factors = response.linear?.factors;
  const list = factors ? family.walls.map(([wall, f]) => [wall, factors[f].correlation]) :
      response.sobol           ? family.walls.map(([wall, f]) => [wall, response.sobol[f].total[0]]) :
      response.morris          ? family.walls.map(([wall, f]) => [wall, response.morris[f].mu[0]]) :
                                 [];
  return list.filter(([, value]) => finite(value) !== null);
}

/** Draws the flat sheet with each wall coloured by the effect of its factor on the response. */
function drawOnLayout(data, response, family, width) {
  const list = sensitivities(response, family), lines = data.layout.walls_mm;
  const xs = lines.flatMap(([a, , c]) => [a, c]), ys = lines.flatMap(([, b, , d]) => [b, d]);
  const left = Math.min(...xs), right = Math.max(...xs), low = Math.min(...ys), high = Math.max(...ys);
  const margin = 10, scale = Math.min((width - 2 * margin) / (right - left || 1), 420 / (high - low || 1));
  const X = (x) => margin + (x - left) * scale, Y = (y) => margin + (high - y) * scale;
  const largest = Math.max(...list.map(([, value]) => Math.abs(value)), 1e-12);
  const thick = Math.min(Math.max(2.5, scale * 1.2), 7);
  return drawing(
      width, (high - low) * scale + 2 * margin, `${factorNamed(family.name).words} on the layout`,
      lines.map(([a, b, c, d]) => svg("path", {class: "axis", d: path([[X(a), Y(b)], [X(c), Y(d)]])})),
      list.map(([wall, value]) => {
        const [a, b, c, d] = lines[wall];
        return svg(
            "path", {
              d: path([[X(a), Y(b)], [X(c), Y(d)]]),
              stroke: tiltColour(value, largest),
              "stroke-width": thick,
              "stroke-linecap": "round"
            },
            svg("title", {}, `wall ${wall}: ${figures(value)}`));
      }));
}

function levelX(level) {
  return (level.range[0] + level.range[1]) / 2;
}

/** Draws samples as dots, and the mean of each level as a line with two standard errors. */
function drawEffect(data, r, k, width) {
  const response = data.responses[r],
        levels = (response.main_effects?.[k]?.levels ?? []).filter((l) => finite(l.mean) !== null);
  const dots = (data.scatter ?? [])
                   .map((row) => [row[k], row[data.factors.length + r]])
                   .filter(([x, y]) => finite(x) !== null && finite(y) !== null);
  const xs = [...dots.map(([x]) => x), ...levels.flatMap((l) => l.range)],
        ys = [...dots.map(([, y]) => y), ...levels.map((l) => l.mean)];
  if (xs.length === 0) return missing("No sample has this response.");
  const range = (values) => values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
  const of = named(response.name), by = factorWithUnit(data.factors[k]);
  const axes = plot({
    width,
    height: 230,
    left: 70,
    label: `${of.words} over ${by.words}`,
    x: {range: padded(range(xs), 0.03), label: by.unit ? `${by.words}, ${by.unit}` : by.words},
    y: {range: padded(range(ys)), label: of.unit ? `${of.words}, ${of.unit}` : of.words}
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

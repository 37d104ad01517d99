// Plots with two labelled axes, linear or logarithmic.

function niceStep(span, most) {
  const rough = span / most, power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((k) => k * power).find((step) => step >= rough * 0.999);
}

function linearTicks([low, high], most) {
  const step = niceStep(high - low || 1, most), ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) ticks.push(k * step);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return ticks.map((at) => ({at, text: withSign(at, Math.abs(at).toFixed(Math.min(decimals, 9)))}));
}

function logTicks([low, high], most) {
  const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
  const step = Math.max(1, Math.ceil((last - first + 1) / most)), ticks = [];
  const short = first >= -3 && last <= 4;
  for (let k = first; k <= last; k += step)
    ticks.push({at: 10 ** k, text: short ? String(Number((10 ** k).toPrecision(1))) : powerOfTen(k)});
  return ticks;
}

function padded([low, high], share = 0.06) {
  const pad = (high - low || Math.abs(high) || 1) * share;
  return [low - pad, high + pad];
}

/** Returns the axis range for bars: from 0 to the values on both sides, with a margin at ends other than 0. */
function barRange(values, share = 0.06) {
  const low = Math.min(0, ...values), high = Math.max(0, ...values), pad = (high - low || 1) * share;
  return [low < 0 ? low - pad : 0, high > 0 || low === 0 ? high + pad : 0];
}

/** Returns the whole decades around positive values. */
function decades(values) {
  const low = Math.floor(Math.log10(Math.min(...values)) + 1e-9),
        high = Math.ceil(Math.log10(Math.max(...values)) - 1e-9);
  return [10 ** low, 10 ** Math.max(high, low + 1)];
}

function mapping(axis, from, to) {
  const f = axis.log ? Math.log10 : (v) => v;
  const [low, high] = axis.range.map(f);
  return (v) => from + ((f(v) - low) / (high - low || 1)) * (to - from);
}

/** Makes the axes of a plot; axis: {range, label, log, ticks}. Callers append marks to `root` at X(value), Y(value). */
function plot({width, height = 240, label, x, y, left = 58}) {
  const area = {left, right: width - 14, top: 30, bottom: height - 42};
  const X = mapping(x, area.left, area.right), Y = mapping(y, area.bottom, area.top);
  const xTicks =
      x.ticks ?? (x.log ? logTicks : linearTicks)(x.range, Math.max(3, (area.right - area.left) / 90));
  const yTicks =
      y.ticks ?? (y.log ? logTicks : linearTicks)(y.range, Math.max(3, (area.bottom - area.top) / 30));
  const root = drawing(
      width, height, label,
      svg("g", {class: "grid"},
          yTicks.map(({at}) => svg("path", {d: path([[area.left, Y(at)], [area.right, Y(at)]])}))),
      svg("g", {class: "ticks"},
          yTicks.map(
              ({at, text}) => svg("text", {x: area.left - 8, y: Y(at) + 4, "text-anchor": "end"}, text)),
          xTicks.map(
              ({at, text}) => svg("text", {x: X(at), y: area.bottom + 17, "text-anchor": "middle"}, text)),
          xTicks.map(
              ({at}) =>
                  svg("path", {class: "tick", d: path([[X(at), area.bottom], [X(at), area.bottom + 5]])}))),
      svg("path", {class: "axis", d: path([[area.left, area.bottom], [area.right, area.bottom]])}),
      svg("text", {class: "label", x: 2, y: 14}, y.label),
      svg("text", {class: "label", x: area.right, y: height - 6, "text-anchor": "end"}, x.label));
  return {root, X, Y, area};
}

/** Returns the ticks under bars with numbers first .. first + count - 1. */
function columnTicks(first, count, width) {
  const step = Math.max(1, niceStep(count, Math.max(2, Math.min(count, width / 34))));
  const ticks = [];
  for (let c = Math.ceil(first / step) * step; c < first + count; c += step)
    ticks.push({at: c, text: withSign(c, String(Math.abs(c)))});
  return ticks;
}

function columnAxis({firstColumn, columns}, width) {
  return {
    range: [firstColumn - 0.6, firstColumn + columns - 0.4],
    label: "column",
    ticks: columnTicks(firstColumn, columns, width - 70)
  };
}

function bar(axes, column, value, attributes) {
  const half = Math.min(0.38 * (axes.X(1) - axes.X(0)), 22);
  const zero = axes.Y(0), top = axes.Y(value);
  const box = {
    x: axes.X(column) - half,
    y: Math.min(zero, top),
    width: 2 * half,
    height: Math.max(Math.abs(zero - top), 0.5)
  };
  return svg("rect", {...box, ...attributes});
}

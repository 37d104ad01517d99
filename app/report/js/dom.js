// Makes elements, and figures that are redrawn when their width changes. Text is inserted as text, never as markup.

function fill(node, attributes, children) {
  for (const [key, value] of Object.entries(attributes ?? {}))
    if (typeof value === "function")
      node.addEventListener(key, value);
    else if (value !== null && value !== undefined)
      node.setAttribute(key, value);
  node.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return node;
}

function html(tag, attributes, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

function svg(tag, attributes, ...children) {
  return fill(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

function drawing(width, height, label, ...children) {
  const size = {width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": label};
  return svg("svg", size, children);
}

function path(points, closed = false) {
  return points.length ?
      "M" + points.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join("L") + (closed ? "Z" : "") :
      "";
}

const pageFigures = [];

/** Makes a box whose content is `draw(width in px)`. */
function responsive(draw) {
  const box = html("div", {class: "figure"});
  pageFigures.push({box, draw, width: 0});
  return box;
}

/** Replaces the content of a box unless it is already there: reinsertion would lose the focus and the pointer. */
function keepInPlace(box, content) {
  if (box.childNodes.length !== 1 || box.firstChild !== content) box.replaceChildren(content);
}

function drawAll(force = false, fixedWidth = 0) {
  for (const figure of pageFigures) {
    const width = Math.floor(fixedWidth || figure.box.clientWidth);
    if (width < 1 || (!force && width === figure.width)) continue;
    figure.width = width;
    guarded(() => keepInPlace(figure.box, figure.draw(width)));
  }
}

function redraw(box) {
  const figure = pageFigures.find((entry) => entry.box === box);
  if (figure?.width) guarded(() => keepInPlace(figure.box, figure.draw(figure.width)));
}

/** Shows an error at the top of the page. The rest of the report is still drawn. */
function problem(message) {
  const box = document.getElementById("problems");
  box.hidden = false;
  box.append(html("p", {}, message));
}

function guarded(work) {
  try {
    return work();
  } catch (error) {
    problem(`A part of this report could not be drawn: ${error?.stack ?? error}`);
    return null;
  }
}

function colour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue("--" + name).trim();
}

function channels(hex) {
  return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
}

/** Interpolates between two "#rrggbb" colours, t in [0, 1]. */
function blend(from, to, t) {
  return `rgb(${mix(channels(from), channels(to), t).map(Math.round).join(",")})`;
}

/** Returns the colour of a tilt on a diverging scale; the middle is a tilt of 0. */
function tiltColour(beta, largest) {
  const share = largest > 0 ? Math.max(-1, Math.min(1, beta / largest)) : 0;
  return blend(colour("tilt-none"), colour(share < 0 ? "tilt-minus" : "tilt-plus"), Math.abs(share));
}

function legend(...entries) {
  const items = entries.filter(Boolean).map(
      ([kind, text]) => html("li", {}, html("span", {class: "key " + kind}), text));
  return html("ul", {class: "legend"}, items);
}

function missing(text) {
  return html("p", {class: "missing"}, text);
}

function table(heads, rows, name) {
  const head = html("tr", {}, heads.map((text) => html("th", {scope: "col"}, text)));
  const body =
      rows.map((row) => html("tr", {class: row.mark ?? null}, row.cells.map((cell) => html("td", {}, cell))));
  return html("table", {"aria-label": name}, html("thead", {}, head), html("tbody", {}, body));
}

// Elements of the page. Text is inserted as text, never as markup.

export const $ = (id) => document.getElementById(id);

export function element(tag, attributes = {}, ...children) {
  return filled(document.createElement(tag), attributes, children);
}

export function svg(tag, attributes = {}, ...children) {
  return filled(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

function filled(node, attributes, children) {
  for (const [key, value] of Object.entries(attributes))
    if (typeof value === "function") node.addEventListener(key, value);
    else if (value !== null && value !== undefined && value !== false) node.setAttribute(key, value === true ? "" : value);
  node.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return node;
}

export function show(node, on) {
  node.hidden = !on;
}

/** Formats a number for people: at most `digits` decimals, without trailing zeros; a dash without a number. */
export function neat(value, digits = 3) {
  return Number.isFinite(value) ? String(Number(value.toFixed(digits))).replace("-", "\u2212") : "\u2013";
}

/** Formats a number for an input field. */
export function typed(value, digits = 4) {
  return Number.isFinite(value) ? String(Number(value.toFixed(digits))) : "";
}

/** Converts a run's summary to its first line and rows. Each line is a name and its value, or a severity and a problem;
 *  a line without a name continues the row before. */
export function summaryRows(summary) {
  const [first, ...lines] = summary.split("\n").filter((line) => line.trim()), rows = [];
  for (const line of lines) {
    const [, name, words] = /^\s{0,2}((?:warning|error):(?=\s)|\S[^\s]*(?: \S+)*?(?=\s{2}))?\s+(.*)$/.exec(line) ?? [null, "", line.trim()];
    rows.push(element("div", {}, element("dt", {}, name ?? ""), element("dd", {}, words)));
  }
  return [element("p", {class: "note"}, first ?? ""), element("dl", {class: "rows"}, rows)];
}

/** Describes the fold of a sheet for people. */
export const describeFold = (theta_rad) => (Math.abs(theta_rad) < 1e-9 ? "flat" : `${neat((theta_rad * 180) / Math.PI, 1)}\u00b0`);

export const degrees = (radians) => (radians * 180) / Math.PI;
export const radians = (degrees) => (degrees * Math.PI) / 180;

// Text of a target.yaml (formats.md). Lengths in mm, angles in degrees.

export const number = (value) => Number(Number(value).toFixed(3));
export const pairs = (points) => `[${points.map(([x, y]) => `[${number(x)}, ${number(y)}]`).join(", ")}]`;
export const inQuotes = (text) => `"${String(text).replace(/[\\"]/g, "\\$&")}"`;
export const targetFile = (name, target, rest = []) => [`kinetix: 1`, `name: ${name}`, `target: ${target}`, ...rest, ""].join("\n");

/** Describes an input field for a number. */
export const field = (name, text, value, {unit = "", min = 1, max = 1000, step = "any"} = {}) => ({name, text, value, unit, min, max, step});

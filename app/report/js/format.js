// Formats numbers as text. A value that is not a finite number (NaN is null in JSON) becomes a dash.

const DASH = "\u2013";
const MINUS = "\u2212";
const SPACE = "\u00a0";

function finite(value) {
  return typeof value === "number" && Number.isFinite(value) ? value : null;
}

function plain(value, significant, most) {
  const size = Math.abs(value);
  const decimals = size === 0 ? 0 : significant - 1 - Math.floor(Math.log10(size));
  return Math.max(size, 0).toFixed(Math.min(Math.max(decimals, 0), most));
}

function withSign(value, text) {
  return (value < 0 && Number(text) !== 0 ? MINUS : "") + text;
}

const SUPERSCRIPTS = "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079";

function powerOfTen(exponent) {
  const raised = [...String(Math.abs(exponent))].map((digit) => SUPERSCRIPTS[Number(digit)]).join("");
  return "10" + (exponent < 0 ? "\u207b" : "") + raised;
}

function scientific(value) {
  const [mantissa, exponent] = Math.abs(value).toExponential(1).split("e");
  return (value < 0 ? MINUS : "") + mantissa + SPACE + "\u00d7" + SPACE + powerOfTen(Number(exponent));
}

/** Formats a pure number with a few significant digits; very small and very large ones as powers of ten. */
function figures(value, significant = 3) {
  if (finite(value) === null) return DASH;
  const size = Math.abs(value);
  if (size > 0 && (size < 1e-3 || size >= 1e6)) return scientific(value);
  return withSign(value, plain(value, significant, 6));
}

/** Formats a limit from a file, without trailing zeros. */
function neat(value) {
  return finite(value) === null ? DASH : String(Number(value.toPrecision(3)));
}

/** Formats a length or angle with at most `most` decimals; smaller values as "< 0.001". */
function measured(value, unit, most) {
  if (finite(value) === null) return DASH;
  const least = 10 ** -most;
  if (value !== 0 && Math.abs(value) < least) return "<" + SPACE + least.toFixed(most) + unit;
  return withSign(value, String(Number(plain(value, 3, most)))) + unit;
}

function millimetres(value) {
  return measured(value, SPACE + "mm", 3);
}

function percent(fraction) {
  return finite(fraction) === null ? DASH : measured(100 * fraction, SPACE + "%", 3);
}

function degrees(value) {
  return finite(value) === null ? DASH : withSign(value, Math.abs(value).toFixed(1)) + "\u00b0";
}

function toDegrees(radians) {
  return finite(radians) === null ? null : (radians * 180) / Math.PI;
}

function duration(seconds) {
  if (finite(seconds) === null) return DASH;
  if (seconds === 0) return "0" + SPACE + "s";
  const text = (value, unit) => String(Number(value.toPrecision(value < 10 ? 2 : 3))) + SPACE + unit;
  if (seconds < 1e-3) return text(seconds * 1e6, "\u00b5s");
  if (seconds < 1) return text(seconds * 1e3, "ms");
  return seconds < 120 ? text(seconds, "s") : text(seconds / 60, "min");
}

function count(value, one, many) {
  return `${value}${SPACE}${value === 1 ? one : many}`;
}

/** Converts an identifier to words: "no_progress" -> "no progress". */
function words(identifier) {
  return String(identifier ?? "").replace(/_/g, " ");
}

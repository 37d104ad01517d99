// What a sweep's report says in words: names with their units, values of factors, the answer.

const UNIT_WORDS = {
  mm: "mm",
  deg: "\u00b0",
  rad: "rad",
  N: "N",
  Nmm: "N" + SPACE + "mm",
  s: "s",
  mJ: "mJ",
  mm2: "mm\u00b2",
  mm3: "mm\u00b3"
};

/** "moved_rms_mm" -> {words: "moved rms", unit: "mm"}; a name that ends in no unit is a pure number. */
function named(name) {
  const parts = name.split("_"), unit = UNIT_WORDS[parts[parts.length - 1]];
  const said = unit && parts.length > 1 ? parts.slice(0, -1) : parts;
  return {words: said.join(" "), unit: unit ?? ""};
}

function withUnit(text, unit) {
  return text === DASH || unit === "" ? text : text + (unit === "\u00b0" ? "" : SPACE) + unit;
}

/** A factor's or family's path for people: "design.walls[*].t_mm" -> {words: "t, each wall", unit: "mm"}. */
function factorNamed(path) {
  const parts = path.replace(/^design\./, "").split("."), last = named(parts[parts.length - 1]);
  const where = parts.slice(0, -1).map(
      (part) => part.replace(/^(\w+?)s?\[\*\]$/, "each $1").replace(/^(\w+?)s?\[(\d+)\]$/, "$1 $2").replace(/_/g, " "));
  return {words: [last.words, ...where].join(", "), unit: last.unit};
}

function valuesWords(factor, unit) {
  const said = (value) => withUnit(neat(value), unit);
  if (factor.range) return `${neat(factor.range[0])} to ${said(factor.range[1])}`;
  if (factor.normal) return `normal, mean ${said(factor.normal.mean)}, sd ${said(factor.normal.sd)}`;
  const values = factor.values ?? [];
  return values.length > 8 ?
      `${values.length} values, ${neat(values[0])} to ${said(values[values.length - 1])}` :
      values.map(neat).join(", ") + (unit ? ` ${unit}` : "");
}

/** [0.83, 0.7, 0.96] -> "83 % (70 to 96)"; what chance alone may give is said to be none. */
function shareWords(share) {
  if (!share || finite(share[0]) === null) return DASH;
  const [value, low, high] = share, whole = (x) => String(Math.round(100 * x));
  const text = `${whole(Math.min(Math.max(value, 0), 1))}${SPACE}%`;
  return finite(low) === null || finite(high) === null ? text : `${text} (${whole(low)} to ${whole(high)})`;
}

function isConstant({spread}) {
  return !(spread.count > 1) || spread.least === spread.most;
}

/** "moved rms: 5.39 mm in the middle, 2.23 to 10.5 mm in 90 of 100 samples" */
function answer(response) {
  const {spread: s, name} = response, {words: said, unit} = named(name);
  if (!s.count) return `${said}: no sample has it`;
  if (isConstant(response)) return `${said}: ${withUnit(figures(s.median), unit)} in every sample`;
  return `${said}: ${withUnit(figures(s.median), unit)} in the middle, ${figures(s.p05)} to ${
      withUnit(figures(s.p95), unit)} in 90 of 100 samples`;
}

/** The family with the largest share of a response, and the share; nothing where none has one. */
function leading(data, response) {
  const shares = response.families ?? [];
  let best = null;
  shares.forEach((share, f) => {
    if (share && finite(share[0]) !== null && (best === null || share[0] > shares[best][0])) best = f;
  });
  return best === null || isConstant(response) ? null : {family: data.families[best], share: shares[best]};
}

/** Which way a response goes with a single factor: " (more with more)"; "" where that is not known. */
function direction(response, family) {
  const e = family.factors.length === 1 ? response.linear?.factors[family.factors[0]] : null;
  if (!e || finite(e.correlation) === null || Math.abs(e.correlation) < 0.3) return "";
  return e.correlation > 0 ? ", which raises it" : ", which lowers it";
}

// Texts of a sweep's report: names with their units, values of factors, the answer.

const UNIT_NAMES = {
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

// Responses in cell edges, whose names have no unit.
const IN_CELL_EDGES = ["gap_peak", "stretch_max", "hinge_gap_max", "hinge_gap_rms", "exact_rms", "exact_max", "verify_rms", "verify_max", "unrest"];

const TIMES = "times the base's";  // unit of factors that multiply a value of the base file

const LEAST_SHARE = 0.1;  // share of the variance: a factor with less does not stand out

/** Splits a name: "moved_rms_mm" -> {words: "moved rms", unit: "mm"}. A name without a unit is a pure number. */
function named(name) {
  if (IN_CELL_EDGES.includes(name)) return {words: words(name), unit: "cell edges"};
  const parts = name.split("_"), unit = UNIT_NAMES[parts[parts.length - 1]];
  const said = unit && parts.length > 1 ? parts.slice(0, -1) : parts;
  return {words: said.join(" "), unit: unit ?? ""};
}

function withUnit(text, unit) {
  return text === DASH || unit === "" ? text : text + (unit === "\u00b0" ? "" : SPACE) + unit;
}

/** Names a path: "design.walls[*].t_mm" -> {words: "t, each wall", unit: "mm"}. Any part of it may have the unit. */
function factorNamed(path) {
  const parts = path.replace(/^design\./, "").split(".").map(named), [last] = parts.slice(-1);
  const where = parts.slice(0, -1).map(
      ({words: part}) => part.replace(/^(\w+?)s?\[\*\]$/, "each $1").replace(/^(\w+?)s?\[(\d+)\]$/, "$1 $2"));
  const {unit} = [...parts].reverse().find((part) => part.unit) ?? last;
  return {words: [last.words, ...where].join(", "), unit};
}

/** Names a factor, with the unit of its values. A factor that multiplies a value of the base has the unit TIMES. */
function factorWithUnit({name, scale}) {
  const {words: said, unit} = factorNamed(name);
  return {words: said, unit: scale ? TIMES : unit};
}

function describeValues(factor) {
  const said = valuesAlone(factor, factorWithUnit(factor).unit);
  return factor.add ? `${said}, added to the base's` : said;
}

const MOST_KINDS = 3;  // kinds of values to list: more would fill the table

/** Describes the values of a family's factors, each kind once. */
function valuesOfFamily(data, factors) {
  const kinds = [...new Set(factors.map((f) => describeValues(data.factors[f])))];
  return kinds.length > MOST_KINDS ? `${kinds.length} kinds, from ${kinds[0]} on` : kinds.join("; ");
}

function valuesAlone(factor, unit) {
  const said = (value) => withUnit(neat(value), unit);
  if (factor.range) return `${neat(factor.range[0])} to ${said(factor.range[1])}`;
  if (factor.normal) return `normal, mean ${said(factor.normal.mean)}, sd ${said(factor.normal.sd)}`;
  const values = factor.values ?? [];
  return values.length > 8 ?
      `${values.length} values, ${neat(values[0])} to ${said(values[values.length - 1])}` :
      values.map(neat).join(", ") + (unit ? ` ${unit}` : "");
}

/** Clamps a share to [0, 1], because estimates may be a little outside. */
function clampedShare(value) {
  return finite(value) === null ? value : Math.min(Math.max(value, 0), 1);
}

/** Formats a share with its interval: [0.83, 0.7, 0.96] -> "83 % (70 to 96)". */
function describeShare(share) {
  if (!share || finite(share[0]) === null) return DASH;
  const [value, low, high] = share.map(clampedShare), whole = (x) => String(Math.round(100 * x));
  const text = `${whole(value)}${SPACE}%`;
  return finite(low) === null || finite(high) === null ? text : `${text} (${whole(low)} to ${whole(high)})`;
}

function isConstant({spread}) {
  return !(spread.count > 1) || spread.least === spread.most;
}

const LEAST_SAMPLES = 20;  // one sample beyond each limit of 90 of 100: fewer samples give no such limit

/** Returns the range of a response: {from, to, words}, for 90 of 100 samples, or for all samples if there are few. */
function within({spread: s}) {
  return s.count < LEAST_SAMPLES ? {from: s.least, to: s.most, words: `all ${s.count}`} : {from: s.p05, to: s.p95, words: "90 of 100"};
}

/** Summarises a response: "moved rms: 5.39 mm in the middle, 2.23 to 10.5 mm in 90 of 100 samples". */
function answer(response) {
  const {spread: s, name} = response, {words: said, unit} = named(name);
  if (!s.count) return `${said}: no sample has it`;
  if (isConstant(response)) return `${said}: ${withUnit(figures(s.median), unit)} in every sample`;
  const {from, to, words: most} = within(response);
  return `${said}: ${withUnit(figures(s.median), unit)} in the middle, ${figures(from)} to ${withUnit(figures(to), unit)} in ${most} samples`;
}

/** Returns the family with the largest share of a response, and the share; null if no share is known. */
function leading(data, response) {
  const shares = response.families ?? [];
  let best = null;
  shares.forEach((share, f) => {
    if (share && finite(share[0]) !== null && (best === null || share[0] > shares[best][0])) best = f;
  });
  return best === null || isConstant(response) ? null : {family: data.families[best], share: shares[best]};
}

/** Describes the leading factor of a response: {sentence, card}. Null if no share is known. */
function leadWords(data, response) {
  const found = leading(data, response);
  if (!found) return null;
  const [value, low] = found.share, name = factorNamed(found.family.name).words;
  if (value < LEAST_SHARE || (finite(low) !== null && low <= 0)) return {sentence: "No factor stands out. ", card: "no factor stands out"};
  const most = value > 0.5;
  return {sentence: `${most ? "Most" : "The largest part"} of it goes with ${name}: ${describeShare(found.share)} of the variance${direction(response, found.family)}. `,
    card: `${most ? "mostly" : "the largest part:"} ${name}`};
}

/** Describes the direction of a single factor's effect: ", which raises it"; "" if it is weak or unknown. */
function direction(response, family) {
  const e = family.factors.length === 1 ? response.linear?.factors[family.factors[0]] : null;
  if (!e || finite(e.correlation) === null || Math.abs(e.correlation) < 0.3) return "";
  return e.correlation > 0 ? ", which raises it" : ", which lowers it";
}

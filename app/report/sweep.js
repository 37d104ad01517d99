// Report of a sweep: the answer, the factors, their effect on each response, and the failures.

const CARDS = 4;

function verdictBox(data) {
  const {counts} = data, bad = data.samples - counts.ok, first = data.responses[0];
  const title = bad > 0 ? `${bad} of ${data.samples} samples did not succeed` :
      first             ? answer(first) :
                          `All ${data.samples} samples were computed`;
  const why = (first && leadWords(data, first)?.sentence) ?? "";
  const done = bad > 0 ?
      ` ${counts.missed} missed, ${counts.disagrees} disagree, ${counts.failed} failed: listed below.` :
      ` All ${data.samples} samples were computed.`;
  return html(
      "div", {class: "verdict " + (bad === 0 ? "good" : "unsure")},
      html("div", {class: "mark"}, bad === 0 ? "\u2713" : "!"),
      html(
          "div", {}, html("h2", {}, title),
          html(
              "p", {},
              `${why}Model ${data.model}, ${words(data.method)}, ${count(data.factors.length, "factor", "factors")}, seed ${
                  data.seed}.${done}`)));
}

/** Makes a card with the median and range of each of the first responses. */
function answerCards(data) {
  const cards = data.responses.slice(0, CARDS).map((response) => {
    const {words: said, unit} = named(response.name), s = response.spread, lead = leadWords(data, response);
    const {from, to, words: most} = within(response);
    const range = isConstant(response) ? "in every sample" : `${figures(from)} to ${withUnit(figures(to), unit)} in ${most}`;
    return html(
        "div", {class: "number"}, html("dt", {}, said),
        html(
            "dd", {}, html("strong", {}, withUnit(figures(s.median), unit)), html("span", {}, range),
            lead ? html("span", {}, lead.card) : null));
  });
  return cards.length ? html("dl", {class: "numbers", style: `grid-template-columns: repeat(${cards.length}, 1fr)`}, cards) : null;
}

/** Makes a table with one row per family. Columns show its share of the variance of each response. */
function factorTable(data) {
  const shown = data.responses.filter((response) => (response.families ?? []).some(Boolean) && !isConstant(response)).slice(0, CARDS);
  const rows = data.families.map(({name, factors}, f) => {
    const {words: said} = factorNamed(name);
    return {
      cells: [
        said, String(factors.length), valuesOfFamily(data, factors),
        ...shown.map((response) => describeShare(response.families[f]))
      ]
    };
  });
  const heads = ["factor", "how many", "values", ...shown.map((response) => named(response.name).words)];
  return [
    html("div", {class: "scroll"}, table(heads, rows, "factors")),
    shown.length ?
        html(
            "p", {class: "note"},
            "Last columns: share of the response's variance that the factors of the row explain, with its 95 % interval if there is one. " +
                (data.method === "factorial" || data.method === "saltelli" ?
                     "For several factors together, the sum of their separate effects." :
                     "For several factors together, only linear effects count; for one, any effect.")) :
        null
  ];
}

function spreadTable(data) {
  const heads = ["response", "unit", "mean", "sd", "least", "5 %", "median", "95 %", "most", "samples"];
  const rows = data.responses.map(({name, spread: s}) => {
    const {words: said, unit} = named(name);
    return {
      cells: [
        said, unit, ...["mean", "sd", "least", "p05", "median", "p95", "most"].map((key) => figures(s[key], 4)),
        String(s.count ?? 0)
      ]
    };
  });
  return html("div", {class: "scroll"}, table(heads, rows, "spread of the responses"));
}

/** Returns the adjusted R2 of a plane: the share of variance it explains, less the share explained by chance. */
function explained({r_squared: share, used, factors}) {
  const slopes = factors.filter(({slope}) => finite(slope) !== null).length;
  return Math.max(1 - (1 - share) * (used - 1) / (used - slopes - 1), 0);
}

function linearTable(data, response) {
  if (!response.linear || finite(response.linear.r_squared) === null) return null;
  const rows = response.plotted.map((k) => {
    const e = response.linear.factors[k], {words: said, unit: own} = factorWithUnit(data.factors[k]),
          of = named(response.name).unit, unit = own === TIMES ? "" : own, per = [of, unit].some(Boolean) ? `${of || "1"} per ${unit || "1"}` : "";
    return {
      cells: [
        said, `${figures(e.slope)} \u00b1 ${figures(e.slope_error, 2)}`, per, figures(e.standardised),
        figures(e.correlation), figures(e.rank_correlation)
      ]
    };
  });
  return html(
      "div", {class: "scroll"},
      html(
          "p", {class: "note"},
          `A plane through all samples explains ${percent(explained(response.linear))} of the variance, less what its slopes explain by chance.`),
      table(["factor", "slope", "unit", "standardised", "correlation", "of ranks"], rows, "linear regression"));
}

/** Draws the flat sheet for each family of wall factors. */
function layouts(data, response) {
  const families = familiesOnWalls(data).filter((family) => sensitivities(response, family).length > 0);
  if (families.length === 0) return null;
  const what = response.linear ? "correlation of the response with the wall's factor" :
      response.sobol           ? "total index of the wall's factor" :
                                 "mean elementary effect of the wall's factor";
  return [
    html("p", {class: "note"}, `On the flat sheet, ${what}. The stronger the colour, the more; with few samples part of it is chance.`),
    html(
        "div", {class: families.length > 1 && !isLong(data.layout) ? "groups" : ""},
        families.map(
            (family) => html(
                "figure", {}, responsive((width) => drawOnLayout(data, response, family, width)),
                html("figcaption", {}, factorNamed(family.name).words)))),
    response.sobol ? null : legend(["raises", "more of the factor raises the response"], ["lowers", "more of it lowers the response"])
  ];
}

/** Describes the lines in plots of single factors. */
function describeLine({method}) {
  if (method === "one_at_a_time") return "Line: the response at each level of the factor, all else as in the first sample.";
  const mean = "Line: mean at each level of the factor, all else left to vary";
  return method === "saltelli" || method === "morris" ? `${mean}.` : `${mean}, with two standard errors.`;
}

/** Describes the samples in plots of single factors. */
function describeDots({scatter, samples}) {
  return scatter.length < samples ? `${scatter.length} of ${samples} samples, drawn by lot` : "samples";
}

function responseSection(data, r) {
  const response = data.responses[r], {what, names} = importance(response);
  if (isConstant(response)) return html("p", {}, answer(response) + ".");
  const several = data.factors.length > 1, left = data.factors.length - response.plotted.length;
  return [
    r > 0 ? html("p", {}, answer(response) + ".") : null,
    responsive((width) => drawSpread(response, width)),
    legend(["turn", `samples, ${response.spread.count} in all`], ["turn-limit", `the middle, and the limits of ${within(response).words} samples`]),
    several ? html("p", {class: "note"}, data.families.length < data.factors.length && (response.families ?? []).some(Boolean) ?
        "Bars: share of the variance that goes with each family of factors. Lines: 95 % intervals." :
        `Bars: ${what}${names ? `; thin: ${names[1]}` : ""}. Lines at their ends: 95 % intervals, where there are any.`) : null,
    several ? responsive((width) => drawImportance(data, response, width)) : null,
    layouts(data, response),
    html(
        "details", {open: left > 0 ? null : ""}, html("summary", {}, "Single factors"),
        html(
            "p", {class: "note"},
            `Dots: ${describeDots(data)}. ${describeLine(data)}` +
                (left > 0 ? ` The most influential of ${data.factors.length} factors are listed. samples.csv has all.` : "")),
        html(
            "div", {class: several ? "groups" : ""},
            response.plotted.map((k) => responsive((width) => drawEffect(data, r, k, width)))),
        linearTable(data, response))
  ];
}

function failureSection(data) {
  const rows = data.failures.map((f) => ({cells: [String(f.sample), f.status, f.reason]}));
  const bad = data.samples - data.counts.ok;
  return [
    bad > rows.length ? html("p", {class: "note"}, `The first ${rows.length} of ${bad}; all are in samples.csv.`) : null,
    html("div", {class: "scroll"}, table(["sample", "status", "reason"], rows, "failures"))
  ];
}

function provenanceSection(data) {
  const facts = [
    ["program", `kinetix ${data.kinetix_version}`], ["seed", String(data.seed)], ["sweep file", data.doe_sha256],
    ["base file", data.base_sha256], ["all files", data.files_sha256]
  ];
  return html(
      "details", {}, html("summary", {}, "Program, seed, files"),
      html(
          "dl", {class: "facts"},
          facts.map(([name, text]) => html("div", {}, html("dt", {}, name), html("dd", {}, text)))),
      html("pre", {class: "scroll"}, data.doe ?? ""));
}

function section(id, title, content) {
  return html("section", {id}, html("h2", {}, title), content ?? missing("This part could not be made."));
}

function build(data) {
  document.title = `${data.name} \u2013 KinetiX sweep`;
  const page = document.getElementById("report");
  page.append(html(
      "header", {id: "headline"}, html("p", {class: "eyebrow"}, "KinetiX sweep"), html("h1", {}, data.name),
      guarded(() => verdictBox(data)), guarded(() => answerCards(data))));
  page.append(section("factors", "What was varied", guarded(() => factorTable(data))));
  if (data.not_analysed) page.append(section("responses", "Responses", missing(data.not_analysed)));
  data.responses.forEach(
      (response, r) =>
          page.append(section(`response-${r}`, named(response.name).words, guarded(() => responseSection(data, r)))));
  if (data.responses.length) page.append(section("responses", "All results", guarded(() => spreadTable(data))));
  if (data.failures.length)
    page.append(section("failures", "Samples that did not succeed", guarded(() => failureSection(data))));
  page.append(section("provenance", "Where it comes from", guarded(() => provenanceSection(data))));
  for (const box of document.querySelectorAll("details")) box.addEventListener("toggle", () => drawAll());
  drawAll();
}

function prepareForPaper(printing) {
  if (printing) {
    document.documentElement.dataset.theme = "light";
    for (const box of document.querySelectorAll("details")) box.open = true;
  } else {
    delete document.documentElement.dataset.theme;
  }
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

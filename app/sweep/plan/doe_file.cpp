#include "app/sweep/plan/doe_file.hpp"

#include <filesystem>

#include "app/files/file_header.hpp"

namespace kinetix::app {
namespace {

namespace value = targets::value;
using targets::needed;
using targets::otherwise;

constexpr int max_levels = 1'000'000;  // per factor; their product has a separate limit
// Values of the key `model`. `bullet` is the earlier name of `rigid_body`.
constexpr targets::Word<Model> models[] = {{"exact", Model::exact},
                                           {"equilibrium", Model::equilibrium},
                                           {"rigid_body", Model::bullet},
                                           {"bullet", Model::bullet}};
/// Values of the key `start`: whether samples start from the base's state.
constexpr targets::Word<bool> starts[] = {{"flat", false}, {"base", true}};
/// Values of the key `method.kind`.
constexpr targets::Word<optim::SamplingMethod> methods[] = {
    {"factorial", optim::SamplingMethod::factorial},
    {"lhs", optim::SamplingMethod::lhs},
    {"sobol", optim::SamplingMethod::sobol},
    {"saltelli", optim::SamplingMethod::saltelli},
    {"monte_carlo", optim::SamplingMethod::monte_carlo},
    {"one_at_a_time", optim::SamplingMethod::one_factor},
    {"morris", optim::SamplingMethod::morris}};

const targets::KeyTable& method_keys() {
  static const optim::SamplingOptions usual{};
  static const targets::KeyTable keys({
      {"kind", value::choice(methods), needed, "sampling method ([methods](#methods-of-a-sweep))"},
      {"samples", value::integer(1, static_cast<int>(max_samples)),
       targets::by_default(static_cast<double>(usual.samples)),
       "number of samples. For `saltelli`: the base N of N (d + 2) rows with d factors. For `morris`: the "
       "number "
       "of trajectories. `factorial` and `one_at_a_time` do not use it"},
      {"levels", value::integer(2, max_levels),
       targets::by_default(static_cast<double>(optim::Factor{}.levels)),
       "levels of a grid, for factors without `levels`"},
      {"seed", value::integer(0, std::numeric_limits<int>::max()), targets::by_default(0.0),
       "seed of the random numbers. `--seed` replaces it"},
  });
  return keys;
}

const targets::KeyTable& path_keys() {
  static const targets::KeyTable keys({
      {"path", value::text("path"), needed, "path of one or more numbers of the base"},
      {"times", &FactorPath::times, value::number(), targets::by_default(FactorPath{}.times),
       "multiplier of the factor"},
      {"plus", &FactorPath::plus, value::number(), targets::by_default(FactorPath{}.plus),
       "summand, added after the multiplication"},
  });
  return keys;
}

const targets::KeyTable& normal_keys() {
  static const targets::KeyTable keys({
      {"mean", &optim::NormalSpread::mean, value::number(),
       targets::needed_as("the mean of the normal distribution"), "mean of the normal distribution"},
      targets::Key("std_dev", &optim::NormalSpread::sd, value::number(targets::above(0)),
                   targets::needed_as("the standard deviation, above 0"), "standard deviation")
          .formerly("sd"),
  });
  return keys;
}

const targets::KeyTable& factor_keys() {
  const targets::ValueType path = value::either({value::text("path"), value::map(path_keys())});
  static const targets::KeyTable keys(
      {
          {"path",
           value::either({value::text("path"), value::map(path_keys()),
                          value::list(path, "a list of these, which vary together")}),
           needed, "numbers of the base that vary ([paths](#paths-of-factors))"},
          {"name", value::text("heading"), otherwise("the first path"),
           "heading of the factor's column, not with `each`"},
          {"range", value::range({}), {}, "evenly spread values between two ends"},
          {"levels", value::integer(2, max_levels), otherwise("`method.levels`"),
           "levels of a grid, not with `values`"},
          {"normal", normal_keys(), "normally distributed values"},
          {"values", value::list(value::number(), "a list of numbers"), {}, "all values of the factor"},
          {"each", &DoeFactor::each, value::boolean(), targets::by_default("false"),
           "makes every number that the path matches a separate factor"},
          {"add", &DoeFactor::add, value::boolean(), targets::by_default("false"),
           "adds the values to those of the base"},
          {"scale", &DoeFactor::scale, value::boolean(), targets::by_default("false"),
           "multiplies the values with those of the base"},
      },
      {{"range", "normal", "values"}});
  return keys;
}

std::string path_beside(const targets::Node& node, const std::string& what) {
  const std::filesystem::path path = node.text(what);
  return path.is_absolute() ? path.string() : (std::filesystem::path(node.folder()) / path).string();
}

Model read_model(const targets::Section& root) {
  Model model = Model::exact;
  root.read("model", model, models);
  return model;
}

bool read_start(const targets::Section& root, Model model) {
  const auto node = root.optional("start");
  if (!node) return false;
  if (model != Model::equilibrium)
    throw node->error("only applies to `model: equilibrium`. Remove the key, or change the model");
  return read_word(*node, starts);
}

std::uint64_t read_count(const targets::Node& node) {
  const double count = node.number(targets::from_to(1, static_cast<double>(max_samples), "samples"));
  if (count != std::floor(count)) throw node.error("is not a whole number. Give a whole number of samples");
  return static_cast<std::uint64_t>(count);
}

DoeMethod read_method(const targets::Section& root) {
  DoeMethod method{.node = root.required("method", "e.g. `method: {kind: sobol, samples: 1024}`")};
  const targets::Section section = root.section("method");
  section.read_needed("kind", "factorial, lhs, sobol, saltelli, monte_carlo, one_at_a_time or morris",
                      method.options.method, methods);
  if (const auto samples = section.optional("samples")) method.options.samples = read_count(*samples);
  section.read("levels", method.levels);
  int seed = 0;
  section.read("seed", seed);
  method.options.seed = static_cast<std::uint64_t>(seed);
  return method;
}

FactorPath read_path(const targets::Node& node) {
  if (node.kind() != targets::Node::Kind::map)
    return {node.located([&] { return targets::parse_path(node.text("a path into the base file")); })};
  const targets::Section section(node, path_keys());
  FactorPath path = read_path(section.required("path", "a path into the base file"));
  section.read_into(path);
  if (path.times == 0)
    throw node.error("`times: 0` removes the effect of the factor. Give another multiplier");
  return path;
}

std::vector<FactorPath> read_paths(const targets::Section& factor) {
  const targets::Node node =
      factor.required("path", "a path into the base file, e.g. `path: design.fold_angle_deg`");
  if (node.kind() != targets::Node::Kind::list) return {read_path(node)};
  std::vector<FactorPath> paths;
  for (const targets::Node& entry : node.list("paths into the base file")) paths.push_back(read_path(entry));
  if (paths.empty()) throw node.error("the list is empty. Give at least one path");
  return paths;
}

std::vector<double> read_list(const targets::Node& node) {
  std::vector<double> values;
  for (const targets::Node& entry : node.list("a list of numbers")) values.push_back(entry.number());
  if (values.empty()) throw node.error("the list is empty. Give at least one number");
  return values;
}

optim::Factor read_values(const targets::Section& factor) {
  optim::Factor values{.name = {}, .distribution = {}, .levels = 0};
  const auto range = factor.optional("range"), normal = factor.optional("normal"),
             list = factor.optional("values");
  if (range.has_value() + normal.has_value() + list.has_value() != 1)
    throw factor.error(
        "the values of the factor are not clear. Give exactly one of `range: [lower, upper]`, `normal: "
        "{mean: m, "
        "std_dev: s}` and `values: [...]`");
  if (const auto levels = factor.optional("levels")) {
    if (list)
      throw levels->error("cannot be combined with `values`, each of which is a level. Remove `levels`");
    values.levels = levels->integer(2, max_levels);
  }
  if (list)
    values.distribution = optim::ValueList{read_list(*list)};
  else if (normal)
    factor.section("normal").read_into(values.distribution.emplace<optim::NormalSpread>());
  else
    factor.read("range", values.distribution.emplace<optim::UniformRange>());
  return values;
}

DoeFactor read_factor(const targets::Node& node) {
  const targets::Section section(node, factor_keys());
  DoeFactor factor{.name = {}, .paths = read_paths(section), .values = read_values(section), .node = node};
  factor.name = to_string(factor.paths[0].path);
  if (const auto name = section.optional("name"))
    factor.name = name->text("a heading for the factor's column");
  section.read_into(factor);
  if (factor.add && factor.scale)
    throw node.error("`add: true` and `scale: true` exclude each other. Remove one of the two keys");
  if (factor.each && section.optional("name"))
    throw section.optional("name")->error(
        "names one column, and `each: true` makes several. Remove `name`, or `each`");
  if (factor.each && factor.paths.size() > 1)
    throw node.error("`each: true` needs a single path. Remove `each`, or give one path");
  return factor;
}

std::vector<DoeFactor> read_factors(const targets::Section& root) {
  const targets::Node node =
      root.required("factors", "e.g. `- {path: design.fold_angle_deg, range: [5, 40], levels: 8}`");
  std::vector<DoeFactor> factors;
  for (const targets::Node& entry : node.list("a list of factors")) factors.push_back(read_factor(entry));
  if (factors.empty()) throw node.error("the list is empty. Give at least one factor");
  return factors;
}

std::vector<targets::Node> read_responses(const targets::Section& root) {
  const targets::Node node =
      root.required("responses", "the metrics to record, e.g. `responses: [area_ratio]`");
  std::vector<targets::Node> responses = node.list("a list of metrics");
  if (responses.empty()) throw node.error("the list is empty. Give at least one response");
  std::vector<std::string> names;
  for (const targets::Node& entry : responses) {
    names.push_back(entry.text("the name of a metric"));
    if (std::count(names.begin(), names.end(), names.back()) > 1)
      throw entry.error("the response is listed twice. Remove one entry");
  }
  return responses;
}

void check_kind_of_file(const targets::Node& root) {
  if (root.kind() == targets::Node::Kind::map && !root.optional("factors")) {
    if (root.optional("design"))
      throw root.error(
          "this file is a design, not a sweep. Run `kinetix-opt simulate DESIGN.yaml`, or give a sweep");
    if (root.optional("target"))
      throw root.error("this file is a target, not a sweep. Run `kinetix-opt TARGET.yaml`, or give a sweep");
  }
}

}  // namespace

const targets::KeyTable& doe_keys() {
  static const targets::KeyTable keys = file_keys({
      {"base", value::text("path of a design.yaml or a target.yaml"), needed,
       "file that the sweep varies. Each sample simulates a design, or searches for a target"},
      {"goal", value::text("path of a target.yaml"), otherwise("none: responses that need one are errors"),
       "target whose curve `shape_rms` and `shape_max` of designs refer to"},
      {"model", value::choice(models), targets::by_default("exact"),
       "model of a sample. `exact`: the analytic motion. `equilibrium`: elastic hinges. `rigid_body`: the "
       "simulation"},
      {"start", value::choice(starts), targets::by_default("flat"),
       "for `model: equilibrium`: `flat` follows the load from flat. `base` starts from the base's state at "
       "the "
       "end of its drive, for small errors"},
      {"method", method_keys(), "sampling method and number of samples", needed},
      {"factors", value::list(value::map(factor_keys()), "a list of factors"), needed,
       "quantities that vary"},
      {"responses", value::list(value::text("metric"), "a list of metrics"), needed,
       "metrics that are recorded ([metrics](#responses-of-a-sweep))"},
  });
  return keys;
}

DoeFile read_doe(const std::string& file) {
  const targets::Node node = targets::read_document(file);
  check_kind_of_file(node);
  const targets::Section root = read_root(node, doe_keys());
  constexpr const char* a_base = "the path of a design.yaml or a target.yaml";
  DoeFile doe{.name = read_name(root),
              .base = path_beside(root.required("base", a_base), a_base),
              .goal = {},
              .model = read_model(root),
              .method = read_method(root),
              .factors = read_factors(root),
              .responses = read_responses(root),
              .root = node};
  doe.from_base = read_start(root, doe.model);
  if (const auto goal = root.optional("goal"))
    doe.goal = path_beside(*goal, "the path of a target to measure against");
  return doe;
}

}  // namespace kinetix::app

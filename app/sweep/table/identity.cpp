#include "app/sweep/table/identity.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "app/io/sha256.hpp"
#include "app/version.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/tree.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;

// Bytes, 1 GiB, of a file that a sweep names: more than any reader takes, meshes (256 MiB) included.
constexpr std::size_t max_file_bytes = std::size_t{1} << 30;
constexpr int deepest = 3;  // files: a sweep names a base or a goal, which names its points; one to spare

/// Hashes of files in the order in which they are named, so that two that change places are other files.
struct NamedFiles {
  std::set<std::string> paths;
  std::string hashes;  ///< a line each
};

/// Adds the files that a document names, and those that these name.
void add_files(const targets::Node& root, NamedFiles& files, int depth) {
  for (const targets::Tree::Item& item : root.tree().items) {
    if (item.kind != targets::Node::Kind::scalar || item.value.empty()) continue;
    const fs::path path = fs::path(root.folder()) / item.value;
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored) || !files.paths.insert(path).second) continue;
    files.hashes += sha256(targets::read_bytes(path, max_file_bytes)) + "\n";
    if (depth < deepest && (path.extension() == ".yaml" || path.extension() == ".yml"))
      add_files(targets::read_document(path, max_design_bytes), files, depth + 1);
  }
}

/// Whatever the folder is called, the same files give the same hash.
std::string files_hash(const SweepPlan& plan) {
  NamedFiles files;
  add_files(plan.doe.root, files, 0);
  add_files(plan.base.root, files, 0);
  return sha256(files.hashes);
}

std::string factor_names(const SweepPlan& plan) {
  nlohmann::json names = nlohmann::json::array();
  for (const optim::Factor& factor : plan.samples.factors()) names.push_back(factor.name);
  return names.dump();
}

std::string response_names(const SweepPlan& plan) {
  nlohmann::json names = nlohmann::json::array();
  for (const Metric& metric : plan.responses) names.push_back(metric.name);
  return names.dump();
}

std::string method_name(const SweepPlan& plan) {
  return plan.doe.method.node.required("kind", "").text("a method");
}

// Entries that two tables of one sweep share, and how a message calls what differs.
constexpr std::pair<const char*, const char*> deciding[] = {
    {"schema", "the table's format"},          {"kinetix_version", "the program's version"},
    {"doe_sha256", "the sweep file"},          {"base_sha256", "the base file"},
    {"files_sha256", "a file that they name"}, {"seed", "the seed"}};

std::string value_of(const SweepIdentity& identity, const std::string& key) {
  for (const auto& [name, value] : identity)
    if (name == key) return value;
  return {};
}

}  // namespace

SweepIdentity identify(const SweepPlan& plan) {
  const std::string doe = targets::read_bytes(plan.doe.root.place().file, max_file_bytes);
  const std::string base = targets::read_bytes(plan.doe.base, max_file_bytes);
  return {{"schema", "kinetix-sweep/1"},
          {"kinetix_version", version},
          {"name", plan.doe.name},
          {"model", to_string(plan.doe.model)},
          {"method", method_name(plan)},
          {"samples", std::to_string(plan.size())},
          {"seed", std::to_string(plan.seed)},
          {"factors", factor_names(plan)},
          {"responses", response_names(plan)},
          {"doe_sha256", sha256(doe)},
          {"base_sha256", sha256(base)},
          {"files_sha256", files_hash(plan)},
          {"doe", doe},
          {"base", base}};
}

std::string difference(const SweepIdentity& there, const SweepIdentity& asked) {
  for (const auto& [key, what] : deciding)
    if (value_of(there, key) != value_of(asked, key)) return what;
  return {};
}

}  // namespace kinetix::app

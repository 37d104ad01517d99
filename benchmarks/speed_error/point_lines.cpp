#include "benchmarks/speed_error/point_lines.hpp"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

namespace kinetix::bench {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::stringstream rest(line);
  for (std::string field; std::getline(rest, field, '\t');) fields.push_back(field);
  return fields;
}

double number(const std::string& field) {
  std::size_t used = 0;
  const double value = std::stod(field, &used);
  if (used != field.size()) throw std::invalid_argument(field);
  return value;
}

}  // namespace

std::string to_line(const std::string& scene, const MeasuredPoint& p) {
  return fmt::format("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}", scene, p.method, p.settings, p.precision,
                     p.seconds, p.spread, p.error, p.status, p.is_result ? "result" : "no result");
}

SceneAndPoint from_line(const std::string& line) {
  const std::vector<std::string> f = fields_of(line);
  if (f.size() != 9 || (f[8] != "result" && f[8] != "no result"))
    throw std::runtime_error("not a measured point: " + line);
  try {
    return {f[0], {f[1], f[2], f[3], number(f[4]), number(f[5]), number(f[6]), f[7], f[8] == "result"}};
  } catch (const std::logic_error&) {
    throw std::runtime_error("a measured point with a bad number: " + line);
  }
}

}  // namespace kinetix::bench

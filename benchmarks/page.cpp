#include "benchmarks/page.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace kinetix::bench {
namespace {

std::string replaced(const std::string& page, const std::string& mark, const std::string& text) {
  const auto opening = page.find("<!-- " + mark + ": "), to = page.find("<!-- end of " + mark + " -->");
  if (opening == std::string::npos || to == std::string::npos)
    throw std::runtime_error("the page has no " + mark);
  return page.substr(0, page.find('\n', opening) + 1) + text + page.substr(to);
}

}  // namespace

void write_into(const std::string& file, const std::vector<std::pair<std::string, std::string>>& texts) {
  std::stringstream page;
  page << std::ifstream(file).rdbuf();
  std::string all = page.str();
  for (const auto& [mark, text] : texts) all = replaced(all, mark, text);
  std::ofstream(file) << all;
}

}  // namespace kinetix::bench

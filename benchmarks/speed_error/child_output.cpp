#include "benchmarks/speed_error/child_output.hpp"

#include <array>
#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace kinetix::bench {

std::vector<std::string> lines_printed_by(const std::string& command) {
  FILE* const pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::array<char, 4096> part;
  while (std::fgets(part.data(), part.size(), pipe)) text += part.data();
  if (pclose(pipe) != 0) throw std::runtime_error(command + " ended with an error");
  std::vector<std::string> lines;
  std::stringstream rest(text);
  for (std::string line; std::getline(rest, line);) lines.push_back(line);
  return lines;
}

}  // namespace kinetix::bench

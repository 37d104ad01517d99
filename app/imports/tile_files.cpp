#include "app/imports/tile_files.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <map>

#include "model/base/invalid_input.hpp"
#include "targets/document/text_file.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_tile_bytes = 64 << 20;  // bytes of a file: more than a million corners

/// Number in a text, with its column.
struct FoundNumber {
  double value;
  int column;  ///< from 1
};

struct NumberLine {
  int number;  ///< from 1
  std::vector<FoundNumber> numbers;
};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == ','; }

/// Reads a line of finite numbers between blanks.
std::vector<FoundNumber> numbers_of(const std::string& line, const Place& place) {
  std::vector<FoundNumber> out;
  const char* const end = line.data() + line.size();
  for (const char* at = line.data(); at != end;) {
    if (is_blank(*at)) {
      ++at;
      continue;
    }
    const int column = static_cast<int>(at - line.data()) + 1;
    FoundNumber found{0, column};
    const auto [stop, error] = std::from_chars(at, end, found.value);
    if (error != std::errc() || (stop != end && !is_blank(*stop)) || !std::isfinite(found.value))
      throw InvalidInput("is no number; a line holds numbers between blanks",
                         {place.file, place.line, column});
    out.push_back(found);
    at = stop;
  }
  return out;
}

/// Reads the lines that are not empty.
std::vector<NumberLine> number_lines(const std::string& file) {
  const std::string text = targets::read_text_file(file, max_tile_bytes);
  std::vector<NumberLine> out;
  int number = 0;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    NumberLine line{++number, numbers_of(text.substr(from, to - from), {file, number})};
    if (!line.numbers.empty()) out.push_back(std::move(line));
    from = to + 1;
  }
  return out;
}

using Corners = std::vector<std::vector<Eigen::Vector3d>>;

Corners read_corners(const std::string& file) {
  Corners out;
  for (const NumberLine& line : number_lines(file)) {
    if (line.numbers.size() % 3 != 0 || line.numbers.size() < 9)
      throw InvalidInput(
          fmt::format("has {} numbers; a tile has x, y and z of three corners or more", line.numbers.size()),
          {file, line.number, 1});
    std::vector<Eigen::Vector3d>& tile = out.emplace_back();
    for (std::size_t k = 0; k < line.numbers.size(); k += 3)
      tile.emplace_back(line.numbers[k].value, line.numbers[k + 1].value, line.numbers[k + 2].value);
  }
  if (out.empty()) throw InvalidInput("has no tiles", {file});
  return out;
}

int whole(const FoundNumber& found, const std::string& file, int line) {
  if (found.value != std::floor(found.value) || std::abs(found.value) > 1e9)
    throw InvalidInput("is no whole number", {file, line, found.column});
  return static_cast<int>(found.value);
}

std::vector<model::TileJoint> read_joints(const std::string& file) {
  std::vector<model::TileJoint> out;
  std::map<std::array<int, 4>, std::pair<std::size_t, int>> known;  // by corners: joint, and faces as bits
  for (const NumberLine& line : number_lines(file)) {
    if (line.numbers.size() != 4 && line.numbers.size() != 5)
      throw InvalidInput(
          fmt::format("has {} numbers; a joint is `tile corner tile corner [face]`", line.numbers.size()),
          {file, line.number, 1});
    std::array<int, 4> ends{};
    for (std::size_t k = 0; k < 4; ++k) ends[k] = whole(line.numbers[k], file, line.number);
    const int face = line.numbers.size() == 5 ? whole(line.numbers[4], file, line.number) : 1;
    if (face < 1 || face > 3)
      throw InvalidInput(fmt::format("face {} is not 1 (bottom), 2 (top) or 3 (both)", face),
                         {file, line.number, line.numbers[4].column});
    if (std::pair(ends[0], ends[1]) > std::pair(ends[2], ends[3])) {
      std::swap(ends[0], ends[2]);
      std::swap(ends[1], ends[3]);
    }
    const auto [at, is_new] = known.try_emplace(ends, out.size(), 0);
    at->second.second |= face;
    if (is_new) out.push_back({ends[0], ends[1], ends[2], ends[3]});
    out[at->second.first].both_faces = at->second.second == 3;
  }
  return out;
}

void check_target(const model::TileSheet& sheet, const std::string& file) {
  if (sheet.target.size() != sheet.tiles.size())
    throw InvalidInput(
        fmt::format("has {} tiles; vertices.txt has {}", sheet.target.size(), sheet.tiles.size()), {file});
  for (std::size_t t = 0; t < sheet.tiles.size(); ++t)
    if (sheet.target[t].size() != sheet.tiles[t].size())
      throw InvalidInput(fmt::format("tile {} has {} corners; in vertices.txt it has {}", t + 1,
                                     sheet.target[t].size(), sheet.tiles[t].size()),
                         {file});
}

}  // namespace

bool is_tile_folder(const std::string& path) {
  std::error_code failure;  // set for names that no file can have: reading reports them
  return fs::is_regular_file(fs::path(path) / "vertices.txt", failure);
}

model::TileSheet read_tiles(const std::string& folder) {
  const auto path = [&](const char* name) { return (fs::path(folder) / name).string(); };
  model::TileSheet out;
  out.tiles = read_corners(path("vertices.txt"));
  out.joints = read_joints(path("constraints.txt"));
  std::error_code failure;
  if (!fs::exists(path("target.txt"), failure)) return out;
  out.target = read_corners(path("target.txt"));
  check_target(out, path("target.txt"));
  return out;
}

}  // namespace kinetix::app

#include "app/cli/wrong_file.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "model/base/invalid_input.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;

/// Kind of files that are not YAML, and the YAML file that uses them.
struct FileUse {
  std::vector<std::string_view> endings;
  std::string noun;
  std::string section;      ///< of the YAML file
  std::string keys;         ///< two lines of the section, without the name of the file at their end
  std::string command;      ///< that reads the YAML file, without its path at the end
  std::string advice = {};  ///< for another intention; a sentence
};

constexpr std::string_view model_endings[] = {".3mf", ".step", ".stp", ".glb"};
constexpr std::string_view unread_pictures[] = {".jpg", ".jpeg", ".gif", ".bmp", ".tif", ".tiff", ".webp"};

const std::vector<FileUse>& file_uses() {
  static const std::vector<FileUse> uses = {
      {{".png", ".pbm", ".pgm"}, "a picture", "target", "kind: display\n    image: ", "kinetix-opt "},
      {{".obj", ".stl", ".ply"},
       "a mesh",
       "target",
       "kind: helmet  # for a head; `surface` for an open surface\n    mesh: ",
       "kinetix-opt ",
       "If it has hard and soft parts, run `kinetix-opt import` instead. "},
      {{".svg", ".dxf"},
       "a drawing",
       "structure",
       "lattice: graph  # its lines are the walls, in mm\n    drawing: ",
       "kinetix-opt check ",
       "If it is a picture to show, convert it to PNG. "},
      {{".fold"},
       "a crease pattern",
       "structure",
       "lattice: graph\n    origami: ",
       "kinetix-opt simulate --fold-angle-deg 20 "}};
  return uses;
}

/// Returns the use of a table of points, by the columns of its header.
FileUse use_of_table(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line) && (line.empty() || line[0] == '#')) continue;
  const auto columns = std::count(line.begin(), line.end(), ',') + 1;
  const bool is_plane = line.find('z') == std::string::npos && line.find('Z') == std::string::npos;
  const char* kind = columns == 3 ? "space_curve" : is_plane ? "outline" : "curve";
  const char* header = columns == 3 ? "x,y,z" : is_plane ? "x,y" : "x,z";
  return {{},
          "a table of points",
          "target",
          fmt::format("kind: {}  # points in mm, with the header {}\n    points: ", kind, header),
          "kinetix-opt "};
}

std::optional<FileUse> use_of(const std::string& file, const std::string& ending) {
  if (ending == ".csv") return use_of_table(file);
  for (const FileUse& use : file_uses())
    if (std::find(use.endings.begin(), use.endings.end(), ending) != use.endings.end()) return use;
  return std::nullopt;
}

/// Formats a name as a YAML value: in quotes unless it is a plain word.
std::string yaml_text(const std::string& name) {
  const bool is_plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == '.';
  });
  if (is_plain && std::isalpha(static_cast<unsigned char>(name[0]))) return name;
  return nlohmann::json(name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Describes the YAML file that uses a file of this name.
std::string advice(const FileUse& use, const fs::path& file) {
  fs::path yaml = file;
  yaml.replace_extension(".yaml");
  return fmt::format("{}Save these lines as {} and run `{}{}`:\n  kinetix: 1\n  {}:\n    {}{}", use.advice,
                     yaml.string(), use.command, yaml.string(), use.section, use.keys,
                     yaml_text(file.filename().string()));
}

bool is_one_of(const std::string& ending, const auto& endings) {
  return std::find(std::begin(endings), std::end(endings), ending) != std::end(endings);
}

}  // namespace

void refuse_wrong_file(const std::string& file) {
  const fs::path path(file);
  std::error_code failure;  // ignored: reading the file reports it
  if (!fs::is_regular_file(path, failure)) return;
  const std::string ending = targets::lower_case(path.extension().string());
  if (is_one_of(ending, model_endings))
    throw InvalidInput(fmt::format("this is a 3D model, not a YAML file. Run `kinetix-opt import {}`", file),
                       {file});
  if (is_one_of(ending, unread_pictures)) {
    const fs::path png = fs::path(path).replace_extension(".png");
    throw InvalidInput(
        fmt::format("this is a picture, and kinetix reads PNG, PBM and PGM. Convert it to {}. {}",
                    png.string(), advice(*use_of(png.string(), ".png"), png)),
        {file});
  }
  if (const auto use = use_of(file, ending))
    throw InvalidInput(fmt::format("this is {}, not a YAML file. {}", use->noun, advice(*use, path)), {file});
}

}  // namespace kinetix::app

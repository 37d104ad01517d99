#include "app/cli/error_report.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/files/crease_pattern.hpp"
#include "app/goals/registry.hpp"
#include "model/base/invalid_input.hpp"
#include "targets/document/text_file.hpp"
#include "targets/document/wording.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;

/// Kind of files that are not YAML, and the YAML file that uses them.
struct FileUse {
  std::string noun;
  std::string section;  ///< of the YAML file
  std::string keys;     ///< two lines of the section, without the name of the file at their end
  std::string command;  ///< that reads the YAML file, without its path at the end
  std::string advice;   ///< for another intention, a sentence
};

constexpr std::string_view picture_endings[] = {".png", ".jpg", ".jpeg", ".pbm", ".pgm"};
constexpr std::string_view mesh_endings[] = {".obj", ".off", ".stl", ".ply"};
constexpr std::string_view drawing_endings[] = {".svg", ".dxf"};
constexpr std::string_view pattern_endings[] = {".fold", ".cp"};
constexpr std::string_view model_endings[] = {".3mf", ".step", ".stp", ".glb"};
constexpr std::string_view unread_pictures[] = {".gif", ".bmp", ".tif", ".tiff", ".webp"};

bool is_one_of(const std::string& ending, const auto& endings) {
  return std::find(std::begin(endings), std::end(endings), ending) != std::end(endings);
}

/// Returns the use of a file by the first kind of goal that reads its form. A comment lists all such kinds.
FileUse use_by_goals(const char* noun, std::string_view form, const char* advice = "") {
  const GoalKind* first = nullptr;
  std::string comment;
  for (const GoalKind* kind : goal_kinds()) {
    if (!kind->file || kind->file->form != form) continue;
    comment += first ? fmt::format("; {}: {}", kind->name, kind->meaning) : std::string(kind->meaning);
    if (!first) first = kind;
  }
  return {noun, "target", fmt::format("kind: {}  # {}\n    {}: ", first->name, comment, first->file->key),
          "kinetix-opt ", advice};
}

/// Returns the form of a table of points, by the columns of its header.
std::string_view form_of_table(const std::string& file) {
  std::ifstream in(file);
  std::string header;
  while (std::getline(in, header) && (header.empty() || header[0] == '#')) continue;
  header = targets::lower_case(header);
  if (std::count(header.begin(), header.end(), ',') == 2) return "x,y,z";
  return header.find('y') == std::string::npos ? "x,z" : "x,y";
}

/// Returns whether a drawing has red and blue lines, and all others in colours of creases.
bool has_mountains_and_valleys(const std::string& file, const std::string& ending) {
  if (!is_one_of(ending, drawing_endings)) return false;
  try {
    const std::string text = targets::read_bytes(file, targets::max_drawing_bytes);
    const CreaseLines creases =
        read_drawn_creases(ending == ".svg" ? targets::parse_svg(text) : targets::parse_dxf(text));
    const auto has = [&](char letter) {
      return std::find(creases.letters.begin(), creases.letters.end(), letter) != creases.letters.end();
    };
    return has('M') && has('V');
  } catch (const InvalidInput&) {
    return false;
  }
}

std::optional<FileUse> use_of(const std::string& file, const std::string& ending) {
  if (ending == ".csv") return use_by_goals("a table of points", form_of_table(file));
  if (is_one_of(ending, picture_endings)) return use_by_goals("a picture", "picture");
  if (is_one_of(ending, mesh_endings))
    return use_by_goals("a mesh", "mesh",
                        "If it has hard and soft parts, run `kinetix-opt import` instead. ");
  if (is_one_of(ending, pattern_endings) || has_mountains_and_valleys(file, ending))
    return FileUse{"a crease pattern", "structure",
                   "lattice: graph\n    origami: ", "kinetix-opt simulate --fold-angle-deg 20 ",
                   is_one_of(ending, drawing_endings)
                       ? "If its red and blue lines are walls, write `drawing` in place of `origami`. "
                       : ""};
  if (is_one_of(ending, drawing_endings))
    return FileUse{"a drawing", "structure",
                   "lattice: graph  # its lines are the walls, in mm\n    drawing: ", "kinetix-opt check ",
                   "If it is a picture to show, convert it to PNG. "};
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
        fmt::format("this is a picture, and kinetix reads PNG, JPEG, PBM and PGM. Convert it to {}. {}",
                    png.string(), advice(*use_of(png.string(), ".png"), png)),
        {file});
  }
  if (const auto use = use_of(file, ending))
    throw InvalidInput(fmt::format("this is {}, not a YAML file. {}", use->noun, advice(*use, path)), {file});
}

}  // namespace kinetix::app

#include "tests/fuzz/document_of.hpp"

using namespace kinetix;

namespace {

/// Returns the ending of the format that the content resembles.
std::string ending_of(const std::string& content) {
  if (content.find("<gpx") != std::string::npos) return ".gpx";
  if (content.find('<') != std::string::npos) return ".svg";
  if (content.find("SECTION") != std::string::npos) return ".dxf";
  const bool is_picture = content.starts_with("\x89PNG") || content.starts_with("\xff\xd8") ||
                          (content.starts_with("P") && content.size() > 1 && std::isdigit(content[1]));
  return is_picture ? ".png" : ".dat";
}

}  // namespace

/// Reads a drawing, picture, track or airfoil as the points of each kind of goal that has them, smoothed and in a unit.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string content(reinterpret_cast<const char*>(data), size), name = "input" + ending_of(content);
  fuzz::input_folder().write(name, content);
  const bool has_unit = name.ends_with(".svg") || name.ends_with(".dxf");
  for (const char* kind : {"curve", "space_curve", "outline"})
    for (const char* smooth : {"false", "true", "5"})
      fuzz::read_or_refuse([&] {
        fuzz::check_target(fuzz::document_of("target: {kind: " + std::string(kind) + ", points: " + name +
                                             ", smooth: " + smooth + (has_unit ? "" : ", units: 3") + "}"));
      });
  return 0;
}

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "app/files/bodies_section.hpp"
#include "app/goals/registry.hpp"
#include "app/imports/model_parts.hpp"
#include "app/models/model_file.hpp"
#include "app/pipeline/closed_form.hpp"
#include "app/print/format/zip_text.hpp"
#include "app/studio/messages/templates.hpp"
#include "app/studio/session/session.hpp"
#include "app/sweep/table/sweep_table.hpp"
#include "targets/display/glyph_goal.hpp"
#include "tests/fuzz/input_folder.hpp"

// Readers of every format that the program takes. Each reads one input, for libFuzzer and for replay.cpp.

namespace kinetix::fuzz {
namespace {

using Session = app::studio::Session;

/// Reads a target and its forecast, as `check` does.
void check_target(const targets::Node& root) {
  if (app::read_target(root).goal->forecast().search_s < 0) fail("a search that takes less than no time");
}

/// Reads a design and its forecast, as `check` does.
void check_design(const targets::Node& root) { forecast_design(app::read_design(root)); }

/// Returns a document in the folder of inputs. Its text may name an input.
targets::Node document_of(const std::string& text) {
  return targets::parse_document("kinetix: 1\n" + text + "\n", input_folder().path("document.yaml"));
}

void check_target_text(const std::string& text) {
  read_or_refuse([&] { check_target(document_of(text)); });
}

void check_design_text(const std::string& text) {
  read_or_refuse([&] { check_design(document_of(text)); });
}

/// Writes an input as SVG if it has an element, otherwise with another ending. @return the name
std::string write_drawing(const std::string& input, const std::string& other) {
  const std::string name = input.find('<') != std::string::npos ? "input.svg" : "input" + other;
  input_folder().write(name, input);
  return name;
}

/// Reads a target.yaml.
void read_target_yaml(const std::string& input) {
  const std::string file = input_folder().write("input.yaml", input);
  read_or_refuse([&] { check_target(targets::read_document(file)); });
}

/// Checks that a design and its written text have the same content.
void expect_round_trip(const app::Design& design) {
  const std::string text = design_text(design), file = input_folder().path("again.yaml");
  try {
    if (design_text(app::read_design(targets::parse_document(text, file))) != text)
      fail("another design is read back than was written:\n" + text);
  } catch (const InvalidInput& e) {
    fail(std::string("our own text is refused: ") + e.what() + "\n" + text);
  }
}

/// Reads a design.yaml of a sheet or of general bodies.
void read_design_yaml(const std::string& input) {
  const std::string file = input_folder().write("input.yaml", input);
  read_or_refuse([&] {
    const targets::Node root = targets::read_document(file, app::max_design_bytes);
    if (app::lists_bodies(root)) return void(design_files(app::read_design(root)));
    expect_round_trip(app::read_design(root));
    check_design(root);
  });
}

/// Reads a doe.yaml with its base.
void read_sweep_yaml(const std::string& input) {
  const std::string file = input_folder().write("input.yaml", input);
  read_or_refuse([&] {
    if (app::make_sweep_plan(file, {}).size() < 1) fail("a sweep of nothing");
  });
}

/// Reads the points of a curve in the plane, of a curve in space and of an outline.
void read_curve_csv(const std::string& input) {
  input_folder().write("input.csv", input);
  for (const char* kind : {"curve", "space_curve", "outline"})
    check_target_text("target: {kind: " + std::string(kind) + ", points: input.csv}");
}

/// Returns the ending of the format that the content resembles.
std::string ending_of(const std::string& content) {
  if (content.find("<gpx") != std::string::npos) return ".gpx";
  if (content.find('<') != std::string::npos) return ".svg";
  if (content.find("SECTION") != std::string::npos) return ".dxf";
  const bool is_picture = content.starts_with("\x89PNG") || content.starts_with("\xff\xd8") ||
                          (content.starts_with("P") && content.size() > 1 && std::isdigit(content[1]));
  return is_picture ? ".png" : ".dat";
}

/// Reads a drawing, picture, track or airfoil as the points of each kind of goal that has them, smoothed and in a unit.
void read_points(const std::string& input) {
  const std::string name = "input" + ending_of(input);
  input_folder().write(name, input);
  const bool has_unit = name.ends_with(".svg") || name.ends_with(".dxf");
  for (const char* kind : {"curve", "space_curve", "outline"})
    for (const char* smooth : {"false", "true", "5"})
      check_target_text("target: {kind: " + std::string(kind) + ", points: " + name + ", smooth: " + smooth +
                        (has_unit ? "" : ", units: 3") + "}");
}

/// Reads a FOLD file as the lattice of a design.
void read_fold(const std::string& input) {
  input_folder().write("input.fold", input);
  check_design_text(
      "structure: {lattice: graph, origami: input.fold, tilt_deg: 50}\ndesign: {theta_deg: 25}");
}

/// Reads a crease pattern as the lattice of a design: SVG, or the lines of ORIPA.
void read_creases(const std::string& input) {
  check_design_text("structure: {lattice: graph, origami: " + write_drawing(input, ".cp") +
                    ", tilt_deg: 50}\ndesign: {theta_deg: 25}");
}

/// Reads a drawing as the lattice of a design: SVG or DXF.
void read_drawing(const std::string& input) {
  check_design_text("structure: {lattice: graph, drawing: " + write_drawing(input, ".dxf") +
                    "}\ndesign: {theta_deg: 20}");
}

/// Reads a drawing as the cuts of a sheet, SVG or DXF, and writes the design.
void read_cuts(const std::string& input) {
  const std::string name = write_drawing(input, ".dxf");
  read_or_refuse([&] { design_files(app::read_design(document_of("structure: {cuts: " + name + "}"))); });
}

/// Checks that triangles have existing vertices.
void expect_whole(const targets::TriangleMesh& mesh) {
  for (const auto& triangle : mesh.triangles)
    for (const int v : triangle)
      if (v < 0 || v >= static_cast<int>(mesh.vertices.size())) fail("a triangle of no vertex");
}

/// Reads a file as `import` does: its shells, hard and soft. Then reads its triangles as the other goals do. A helmet's
/// use of them takes a hundred times as long (read_head).
void read_bodies_and_mesh(const std::string& name, const std::string& content) {
  const std::string file = input_folder().write(name, content);
  read_or_refuse([&] {
    app::ImportRequest request;
    request.model = file;
    for (const model::ModelPart& part : app::read_model_parts(request).parts)
      if (part.name.empty()) fail("a part without a name");
  });
  read_or_refuse([&] { expect_whole(app::read_mesh_file(file).mesh); });
}

void read_obj(const std::string& input) { read_bodies_and_mesh("input.obj", input); }
void read_off(const std::string& input) { read_bodies_and_mesh("input.off", input); }
void read_ply(const std::string& input) { read_bodies_and_mesh("input.ply", input); }
void read_stl(const std::string& input) { read_bodies_and_mesh("input.stl", input); }

/// Reads a 3MF package, or the XML of its model. Changes of a package would not reach the XML, since its checksums would
/// be wrong.
void read_threemf(const std::string& input) {
  read_bodies_and_mesh("input.3mf",
                       input.starts_with('<') ? app::zip_text({{"3D/3dmodel.model", input}}) : input);
}

std::string glb_word(std::size_t number) {
  std::string word;
  for (int k = 0; k < 4; ++k) word += static_cast<char>(number >> (8 * k) & 0xff);
  return word;
}

std::string glb_chunk(const std::string& kind, std::string content, char padding) {
  while (content.size() % 4 != 0) content += padding;
  return glb_word(content.size()) + kind + content;
}

/// Returns a file of version 2 with correct lengths: its JSON up to the first byte 0, then its buffer.
std::string glb_of(const std::string& given) {
  const std::size_t end = std::min(given.find('\0'), given.size());
  std::string chunks = glb_chunk("JSON", given.substr(0, end), ' ');
  if (end < given.size()) chunks += glb_chunk(std::string("BIN\0", 4), given.substr(end + 1), '\0');
  return "glTF" + glb_word(2) + glb_word(12 + chunks.size()) + chunks;
}

/// Reads a binary glTF file, or its content: JSON, then its buffer.
void read_glb(const std::string& input) {
  read_bodies_and_mesh("input.glb", input.starts_with('{') ? glb_of(input) : input);
}

/// Reads a PLY file as the head for a helmet, as `check` does.
void read_head(const std::string& input) {
  input_folder().write("input.ply", input);
  check_target_text("target: {kind: helmet, mesh: input.ply}");
}

std::size_t png_number(const std::string& bytes, std::size_t at) {
  std::size_t number = 0;
  for (std::size_t k = at; k < at + 4; ++k) number = number << 8 | static_cast<unsigned char>(bytes[k]);
  return number;
}

/// Computes the checksum of a PNG chunk (W3C 2003, annex D).
std::uint32_t png_sum(std::string_view bytes) {
  constexpr std::uint32_t polynomial = 0xedb88320;  // CRC-32 polynomial, lowest power first
  std::uint32_t sum = 0xffffffff;
  for (const char byte : bytes) {
    sum ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? polynomial : 0);
  }
  return ~sum;
}

/// Returns the bytes with the correct checksum in each chunk. libpng skips chunks with wrong checksums.
std::string with_right_sums(std::string bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = png_number(bytes, at), end = at + 8 + length;
    if (end + 4 > bytes.size()) break;
    const std::uint32_t sum = png_sum(std::string_view(bytes).substr(at + 4, 4 + length));
    for (int k = 0; k < 4; ++k) bytes[end + k] = static_cast<char>(sum >> (24 - 8 * k) & 0xff);
    at = end + 4;
  }
  return bytes;
}

/// Reads a picture as the goal of a display. Its content decides the format.
void read_png(const std::string& input) {
  input_folder().write("input.png", input.starts_with("\x89PNG") ? with_right_sums(input) : input);
  check_target_text("target: {kind: display, image: input.png}");
}

/// Reads a font and draws a letter of two parts.
void read_font(const std::string& input) {
  const std::string file = input_folder().write("input.ttf", input);
  for (const char* text : {"\xc3\x84", "A."})
    read_or_refuse([&] { targets::glyph_picture(text, {"input", file, 0}); });
}

const app::SweepPlan& sweep_plan() {
  static const app::SweepPlan plan = app::make_sweep_plan(input_folder().path("eq3_area.yaml"), {});
  return plan;
}

/// Reads a complete sweep.sqlite as `sweep --resume` does.
void read_sweep_table(const std::string& input) {
  // Shorter than the identity of a run, and the same for every version of the program.
  const app::SweepIdentity identity = {{"schema", "kinetix-sweep/1"}};
  const std::string folder = input_folder().path("out");
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  input_folder().write("out/sweep.sqlite", input);
  read_or_refuse([&] {
    const app::SweepTable table(folder, sweep_plan(), identity, true);
    sweep_json(sweep_plan(), identity, table).dump();
    write_csv(folder, table, sweep_plan(), identity);
  });
}

/// Checks for commands that leave the session's thread or write files. Their duration does not depend on the reader.
bool is_long(const std::string& text) {
  const auto command = nlohmann::json::parse(text, nullptr, false);
  if (!command.is_object()) return false;
  static const std::set<nlohmann::json> types = {"search", "save", "export"};
  return types.contains(command.value("type", nlohmann::json())) ||
         command.value("mode", nlohmann::json()) == "equilibrium";
}

/// Sends a page's messages, one per line, to a session in its thread. The session ends with its answer to the last
/// message.
void read_studio(const std::string& input) {
  const std::string last = "987654321";
  std::stop_source stop;
  Session session({app::studio::template_design("strip"), input_folder().path("saved.yaml"), {}, 1, 0},
                  {[&](int, const app::studio::Text& text) {
                     if (text.bytes->find(last) != std::string::npos) stop.request_stop();
                   },
                   [](const auto&) {}});
  std::istringstream lines(input);
  for (std::string line; std::getline(lines, line);)
    if (!is_long(line)) session.post(0, line);
  session.post(0, R"({"type": "none of the commands", "id": 987654321})");
  session.run(stop.get_token());
}

using Reader = void (*)(const std::string& input);

const std::map<std::string, Reader> readers = {
    {"target_yaml", read_target_yaml},
    {"design_yaml", read_design_yaml},
    {"sweep_yaml", read_sweep_yaml},
    {"curve_csv", read_curve_csv},
    {"points", read_points},
    {"fold", read_fold},
    {"creases", read_creases},
    {"drawing", read_drawing},
    {"cuts", read_cuts},
    {"obj", read_obj},
    {"off", read_off},
    {"ply", read_ply},
    {"stl", read_stl},
    {"head", read_head},
    {"threemf", read_threemf},
    {"glb", read_glb},
    {"png", read_png},
    {"font", read_font},
    {"sweep_table", read_sweep_table},
    {"studio", read_studio},
};

/// Returns the reader that the variable KINETIX_READER names.
Reader chosen_reader() {
  const char* name = std::getenv("KINETIX_READER");
  const auto found = readers.find(name ? name : "");
  if (found == readers.end()) fail("KINETIX_READER names no reader");
  return found->second;
}

}  // namespace
}  // namespace kinetix::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const kinetix::fuzz::Reader reader = kinetix::fuzz::chosen_reader();
  reader(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}

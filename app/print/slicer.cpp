#include "app/print/slicer.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/io/text_pattern.hpp"
#include "app/print/format/zip_text.hpp"
#include "model/base/box.hpp"

namespace kinetix::app {
namespace {

namespace fs = std::filesystem;

constexpr double margin_mm = 50;  // mm around a sheet on the slicer's bed: room for skirts and brims

class WorkFolder {
 public:
  WorkFolder() {
    std::string pattern = (fs::temp_directory_path() / "kinetix-slice-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
      throw std::runtime_error("slicer: no temporary folder can be made");
    path_ = pattern;
  }
  ~WorkFolder() { fs::remove_all(path_, ignored_); }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
  std::error_code ignored_;
};

enum class Ended { well, badly, not_there };

/// Runs a program without a shell, and with nothing on the streams of this program.
Ended run(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &quiet, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  if (error != 0) return Ended::not_there;
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return Ended::badly;
  return WEXITSTATUS(status) == 0 ? Ended::well : Ended::badly;
}

std::string bed_settings(const model::Polyhedron& solid) {
  const Eigen::Vector3d size = model::box_of(solid.points).sizes();
  const double x = std::ceil(size.x() + 2 * margin_mm), y = std::ceil(size.y() + 2 * margin_mm);
  return fmt::format(
      "bed_shape = 0x0,{0}x0,{0}x{1},0x{1}\nmax_print_height = {2}\ndisplay_width = {0}\ndisplay_height = "
      "{1}\ndisplay_pixels_x = {0}\ndisplay_pixels_y = {1}\n",
      x, y, std::ceil(size.z() + margin_mm));
}

/// Returns settings with two extruders, as in the 3MF file.
std::string fdm_settings(bool supports) {
  return fmt::format(R"(printer_technology = FFF
nozzle_diameter = 0.4,0.4
filament_diameter = 1.75,1.75
extrusion_multiplier = 1,1
temperature = 210,210
first_layer_temperature = 210,210
layer_height = 0.2
first_layer_height = 0.2
elefant_foot_compensation = 0
wipe_tower = 0
support_material = {}
)",
                     supports ? 1 : 0);
}

// The time in which a layer hardens is PrusaSlicer's default.
constexpr const char* sla_settings = R"(printer_technology = SLA
layer_height = 0.05
initial_layer_height = 0.05
supports_enable = 0
pad_enable = 0
elefant_foot_compensation = 0
)";

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

double number_of(const std::string& text, const char* pattern) {
  const std::vector<std::string> match = first_match(text, pattern);
  return match.empty() ? std::numeric_limits<double>::quiet_NaN() : std::stod(match[1]);
}

SliceEstimate read_gcode(const std::string& text) {
  SliceEstimate out;
  const auto time = first_match(text, R"(; estimated printing time \(normal mode\) = (.*))");
  out.seconds = time.empty() ? std::numeric_limits<double>::quiet_NaN() : seconds_of(time[1]);
  const auto used = first_match(text, R"(; filament used \[cm3\] = (.*))");
  if (used.empty()) return out;
  for (const std::string& each : all_matches(used[1], R"([0-9.]+)"))
    out.material_mm3 += mm3_per_cm3 * std::stod(each);
  return out;
}

SliceEstimate read_slices(const std::string& file) {
  const std::string text = text_in_zip(file, "config.ini");
  SliceEstimate out;
  out.seconds = number_of(text, R"(printTime = ([0-9.]+))");
  out.material_mm3 = mm3_per_cm3 * number_of(text, R"(usedMaterial = ([0-9.]+))");
  return out;
}

/// One run of a slicer, with the reader of its output.
struct Slicing {
  std::string settings, input;
  const char* action;
  const char* output;
  SliceEstimate (*read)(const std::string& file);
};

SlicerAnswer sliced(const WorkFolder& folder, const std::string& program, const Slicing& slicing) {
  write_file(folder / "settings.ini", slicing.settings);
  const std::string output = folder / slicing.output;
  const Ended ended =
      run({program, slicing.action, "--load", folder / "settings.ini", slicing.input, "-o", output});
  if (ended == Ended::not_there) return {{}, "no slicer found: " + program + " is not on PATH"};
  if (ended == Ended::badly) return {{}, program + " gave up"};
  const SliceEstimate estimate = slicing.read(output);
  if (!(estimate.seconds > 0) || !(estimate.material_mm3 > 0))
    return {{}, program + " said neither time nor material"};
  return {estimate};
}

/// Slices one print after the other. Time and material are those of all prints.
SlicerAnswer all_sliced(const WorkFolder& folder, const std::string& program,
                        const std::vector<Slicing>& prints) {
  SlicerAnswer sum{SliceEstimate{.prints = 0}};
  for (const Slicing& print : prints) {
    const SlicerAnswer one = sliced(folder, program, print);
    if (!one.estimate) return one;
    sum.estimate->seconds += one.estimate->seconds;
    sum.estimate->material_mm3 += one.estimate->material_mm3;
    ++sum.estimate->prints;
  }
  return sum;
}

/// Slices for FDM. Loose rods lie on the bed and need no supports.
SlicerAnswer sliced_fdm(const PrintJob& job, const WorkFolder& folder, const std::string& program) {
  const bool supports = steepest_deg(job.sheet) > steep_deg;
  const std::string sheet = job.sheet.name + ".3mf", rods = job.sheet.name + "_rods.3mf";
  std::vector<Slicing> prints;
  for (const auto& [name, content] : threemf_format.write(job)) {
    if (name != sheet && name != rods) continue;
    const bool is_sheet = name == sheet;
    const std::string file = folder / (is_sheet ? "sheet.3mf" : "rods.3mf");
    write_file(file, content);
    prints.push_back({bed_settings(is_sheet ? hard_part(job) : laid_out_rods(job.sheet)) +
                          fdm_settings(supports && is_sheet),
                      file, "--export-gcode", "sheet.gcode",
                      [](const std::string& gcode) { return read_gcode(text_of(gcode)); }});
  }
  SlicerAnswer out = all_sliced(folder, program, prints);
  if (out.estimate) out.estimate->supports = supports;
  return out;
}

/// Slices for SLA. Hard and soft parts are a print each, and so are loose rods.
SlicerAnswer sliced_sla(const PrintJob& job, const WorkFolder& folder, const std::string& program) {
  std::vector<Slicing> prints;
  for (const auto& [name, content] : stl_format.write(job)) {
    if (name != "hard.stl" && name != "soft.stl" && name != "rods.stl") continue;
    write_file(folder / name, content);
    prints.push_back(
        {bed_settings(name == "rods.stl" ? laid_out_rods(job.sheet) : hard_part(job)) + sla_settings,
         folder / name, "--export-sla", "sheet.sl1", read_slices});
  }
  return all_sliced(folder, program, prints);
}

}  // namespace

double seconds_of(std::string_view text) {
  const auto parts = first_match(text, R"(^(?:(\d+)d)? ?(?:(\d+)h)? ?(?:(\d+)m)? ?(?:(\d+)s)?\s*$)");
  if (text.empty() || parts.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double units[] = {86400, 3600, 60, 1};  // seconds
  double sum = 0;
  for (int k = 0; k < 4; ++k)
    if (!parts[k + 1].empty()) sum += units[k] * std::stod(parts[k + 1]);
  return sum;
}

SlicerAnswer estimate_by_slicer(const PrintJob& job, const std::string& program) {
  const std::string& process = job.sheet.process.name;
  if (process != "fdm" && process != "sla") return {{}, "no slicer found for " + process};
  const WorkFolder folder;
  return process == "fdm" ? sliced_fdm(job, folder, program) : sliced_sla(job, folder, program);
}

}  // namespace kinetix::app

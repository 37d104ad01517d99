#include "tests/app/print/slices.hpp"

#include <fmt/format.h>
#include <leptonica/allheaders.h>
#include <zip.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <numeric>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace kinetix::testing {
namespace {

/// White pixels of a row, from `from` to before `to`.
struct PixelRun {
  int row, from, to, piece;
};

class Pieces {
 public:
  int add() {
    parent_.push_back(static_cast<int>(parent_.size()));
    return parent_.back();
  }
  int root(int k) {
    while (parent_[k] != k) k = parent_[k] = parent_[parent_[k]];
    return k;
  }
  void join(int a, int b) { parent_[root(a)] = root(b); }
  int count() {
    int n = 0;
    for (int k = 0; k < static_cast<int>(parent_.size()); ++k) n += root(k) == k;
    return n;
  }

 private:
  std::vector<int> parent_;
};

std::vector<PixelRun> runs_of(PIX* image, Pieces& pieces) {
  std::vector<PixelRun> runs;
  const int width = pixGetWidth(image), height = pixGetHeight(image), words = pixGetWpl(image);
  for (int y = 0; y < height; ++y) {
    const l_uint32* line = pixGetData(image) + static_cast<long>(y) * words;
    for (int x = 0; x < width;) {
      if (x % 32 == 0 && line[x / 32] == 0) {
        x += 32;
        continue;
      }
      if (!GET_DATA_BIT(line, x)) {
        ++x;
        continue;
      }
      const int from = x;
      while (x < width && GET_DATA_BIT(line, x)) ++x;
      runs.push_back({y, from, x, pieces.add()});
    }
  }
  return runs;
}

/// Joins the pieces of pixel runs that overlap in rows of a and b with `row_step` between them.
void join(const std::vector<PixelRun>& a, const std::vector<PixelRun>& b, int row_step, Pieces& pieces) {
  std::size_t first = 0;
  for (const PixelRun& run : a) {
    while (first < b.size() && (b[first].row < run.row + row_step ||
                                (b[first].row == run.row + row_step && b[first].to <= run.from)))
      ++first;
    for (std::size_t k = first; k < b.size() && b[k].row == run.row + row_step && b[k].from < run.to; ++k)
      pieces.join(run.piece, b[k].piece);
  }
}

std::vector<std::string> layer_names(zip_t* archive) {
  std::vector<std::string> names;
  for (zip_int64_t k = 0; k < zip_get_num_entries(archive, 0); ++k) {
    const std::string name = zip_get_name(archive, static_cast<zip_uint64_t>(k), 0);
    if (name.size() > 4 && name.find('/') == std::string::npos && name.substr(name.size() - 4) == ".png")
      names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Reads the light pixels of a layer.
PIX* layer(zip_t* archive, const std::string& name) {
  zip_stat_t status;
  zip_stat(archive, name.c_str(), 0, &status);
  std::string png(status.size, '\0');
  zip_file_t* file = zip_fopen(archive, name.c_str(), 0);
  zip_fread(file, png.data(), png.size());
  zip_fclose(file);
  PIX* grey = pixReadMem(reinterpret_cast<const l_uint8*>(png.data()), png.size());
  PIX* eight = pixConvertTo8(grey, 0);
  PIX* dark = pixThresholdToBinary(eight, 128);  // 1: black
  PIX* light = pixInvert(nullptr, dark);
  for (PIX* image : {grey, eight, dark}) pixDestroy(&image);
  return light;
}

/// Connected pieces of the layers so far.
class Layers {
 public:
  void add(PIX* image) {
    std::vector<PixelRun> runs = runs_of(image, pieces_);
    join(runs, runs, 1, pieces_);
    join(runs, below_, 0, pieces_);
    below_ = std::move(runs);
  }
  int count() { return pieces_.count(); }

 private:
  Pieces pieces_;
  std::vector<PixelRun> below_;
};

/// Calls a function with each layer of an archive.
void each_layer(const std::string& name, const std::function<void(PIX*)>& use) {
  int error = 0;
  zip_t* archive = zip_open(name.c_str(), ZIP_RDONLY, &error);
  if (archive == nullptr) throw std::runtime_error("no slices in " + name);
  for (const std::string& file : layer_names(archive)) {
    PIX* image = layer(archive, file);
    use(image);
    pixDestroy(&image);
  }
  zip_close(archive);
}

/// Writes a file and returns its path.
std::string written(const std::string& folder, const std::string& name, const std::string& content) {
  const std::string file = folder + "/" + name;
  std::ofstream(file) << content;
  return file;
}

/// Runs the slicer. Its output becomes the error message if it fails.
void run_slicer(const std::string& folder, const std::string& options) {
  const std::string said = folder + "/slicer.txt";
  if (std::system(("prusa-slicer " + options + " >" + said + " 2>&1").c_str()) == 0) return;
  std::stringstream text;
  text << std::ifstream(said).rdbuf();
  throw std::runtime_error("prusa-slicer " + options + "\n" + text.str());
}

constexpr const char* resin_settings = R"(printer_technology = SLA
display_mirror_x = 0
display_mirror_y = 0
display_orientation = landscape
faded_layers = 3
supports_enable = 0
pad_enable = 0
elefant_foot_compensation = 0
)";

constexpr const char* two_extruders = R"(bed_shape = 0x0,400x0,400x400,0x400
nozzle_diameter = 0.4,0.4
filament_diameter = 1.75,1.75
extrusion_multiplier = 1,1
temperature = 200,200
first_layer_temperature = 200,200
layer_height = 0.2
first_layer_height = 0.2
fill_density = 100%
fill_pattern = rectilinear
perimeters = 1
skirts = 0
wipe_tower = 0
)";

constexpr double filament_radius_mm = 1.75 / 2;  // mm, of the filament in two_extruders

/// Returns PrusaSlicer's G-code of a file.
std::string gcode_of(const std::string& folder, const std::string& file, const std::string& profile) {
  const std::string settings = written(folder, "extruders.ini", profile), code = folder + "/slices.gcode";
  run_slicer(folder, "--export-gcode --load " + settings + " " + file + " -o " + code);
  std::stringstream text;
  text << std::ifstream(code).rdbuf();
  return text.str();
}

}  // namespace

std::string sliced(const std::string& folder, const std::string& file, const SlicingOf& how) {
  const std::string settings =
      written(folder, "sla.ini",
              fmt::format("bed_shape = 0x0,{0}x0,{0}x{1},0x{1}\ndisplay_width = {0}\ndisplay_height = "
                          "{1}\ndisplay_pixels_x = {2}\ndisplay_pixels_y = {3}\nslice_closing_radius = {4}\n"
                          "layer_height = {5}\ninitial_layer_height = {5}\n",
                          how.width, how.height, how.pixels * how.width, how.pixels * how.height,
                          how.closing_mm, how.layer_mm) +
                  resin_settings);
  const std::string out = folder + "/slices.sl1";
  run_slicer(folder, "--export-sla --load " + settings + " " + file + " -o " + out);
  return out;
}

double filament_ratio(const std::string& folder, const std::string& file) {
  const std::string all = gcode_of(folder, file, two_extruders);
  std::smatch used;
  if (!std::regex_search(all, used, std::regex(R"(; filament used \[mm\] = ([\d.]+), ([\d.]+))")))
    throw std::runtime_error("no filament in the G-code of " + file);
  return std::stod(used[1]) / std::stod(used[2]);
}

double filament_mm3(const std::string& folder, const std::string& file, const std::string& profile) {
  const std::string all = gcode_of(folder, file, two_extruders + profile);
  std::smatch used;
  if (!std::regex_search(all, used, std::regex(R"(; filament used \[mm\] = ([\d.]+))")))
    throw std::runtime_error("no filament in the G-code of " + file);
  return std::stod(used[1]) * M_PI * filament_radius_mm * filament_radius_mm;
}

int printed_pieces(const std::string& archive) {
  Layers layers;
  each_layer(archive, [&](PIX* image) { layers.add(image); });
  return layers.count();
}

std::pair<int, int> printed_and_swollen_pieces(const std::string& archive, int swelling_px) {
  Layers printed, swollen;
  each_layer(archive, [&](PIX* image) {
    printed.add(image);
    PIX* larger = pixDilateBrick(nullptr, image, 2 * swelling_px + 1, 2 * swelling_px + 1);
    swollen.add(larger);
    pixDestroy(&larger);
  });
  return {printed.count(), swollen.count()};
}

}  // namespace kinetix::testing

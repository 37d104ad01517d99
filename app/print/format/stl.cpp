#include "app/cad/cad_formats.hpp"
#include "app/print/format/print_format.hpp"

namespace kinetix::app {
namespace {

void add_tile(const PrintJob& job, int tile, std::vector<NamedContent>& files) {
  const TileParts parts = tile_parts(job, tile);
  const std::string name = "tile_" + std::to_string(tile + 1);
  files.push_back({name + ".stl", stl_text(job.sheet.name + " " + name, parts.hard)});
  if (!parts.soft.points.empty())
    files.push_back({name + "_soft.stl", stl_text(job.sheet.name + " " + name + " soft", parts.soft)});
}

std::vector<NamedContent> write_stl(const PrintJob& job) {
  const model::Polyhedron hard = hard_part(job), soft = soft_part(job);
  std::vector<NamedContent> files{{"hard.stl", stl_text(job.sheet.name + " hard", hard)}};
  files.push_back({"all.stl", stl_text(job.sheet.name, joined(hard, soft))});
  if (!soft.points.empty()) files.push_back({"soft.stl", stl_text(job.sheet.name + " soft", soft)});
  if (const model::Polyhedron rods = laid_out_rods(job.sheet); !rods.points.empty())
    files.push_back({"rods.stl", stl_text(job.sheet.name + " rods", rods)});
  if (!job.sheet.clip.points.empty())
    files.push_back({"clip.stl", stl_text(job.sheet.name + " clip", rounded_for_file(job.sheet.clip))});
  if (job.sheet.tiles.count() > 1)
    for (int tile = 0; tile < job.sheet.tiles.count(); ++tile) add_tile(job, tile, files);
  return files;
}

}  // namespace

// Entry of the format stl: name, meaning and writer.
const PrintFormat stl_format = {
    .name = "stl", .meaning = "triangles for any slicer", .write = write_stl, .lies_on_bed = true};

}  // namespace kinetix::app

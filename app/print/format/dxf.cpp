#include <fmt/format.h>

#include "app/print/format/print_format.hpp"
#include "app/print/format/sheet_drawing.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector2d;

std::string polyline(const std::vector<Vector2d>& ring, const char* layer) {
  std::string out =
      fmt::format("0\nPOLYLINE\n8\n{}\n66\n1\n70\n1\n10\n0\n20\n0\n30\n0\n", layer);  // 70: closed
  for (const Vector2d& p : ring)
    out += fmt::format("0\nVERTEX\n8\n{}\n10\n{:.5f}\n20\n{:.5f}\n30\n0\n", layer, p.x(), p.y());
  return out + fmt::format("0\nSEQEND\n8\n{}\n", layer);
}

std::string layer(const char* name, int colour) {
  return fmt::format("0\nLAYER\n2\n{}\n70\n0\n62\n{}\n6\nCONTINUOUS\n", name, colour);
}

std::string header(const SheetDrawing& drawing) {
  return fmt::format(
      "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$INSUNITS\n70\n4\n"  // R12, mm
      "9\n$EXTMIN\n10\n{:.5f}\n20\n{:.5f}\n30\n0\n9\n$EXTMAX\n10\n{:.5f}\n20\n{:.5f}\n30\n0\n0\nENDSEC\n",
      drawing.low.x(), drawing.low.y(), drawing.high.x(), drawing.high.y());
}

std::string dxf(const PrintSheet& sheet, const SheetDrawing& drawing) {
  std::string out = header(drawing) + "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n4\n" +
                    layer("BODIES", 7) + layer("SOFT", 5) + layer("RODS", 3) + layer("NUMBERS", 1) +
                    "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
  for (const SheetDrawing::Part& part : drawing.bodies)
    for (const auto& ring : part.rings) out += polyline(ring, "BODIES");
  for (const SheetDrawing::Part& part : drawing.soft)
    for (const auto& ring : part.rings) out += polyline(ring, "SOFT");
  for (const SheetDrawing::Hinge& hinge : drawing.hinges) {
    if (hinge.rod_radius > 0)
      out += fmt::format("0\nCIRCLE\n8\nRODS\n10\n{:.5f}\n20\n{:.5f}\n30\n0\n40\n{:.5f}\n", hinge.place.x(),
                         hinge.place.y(), hinge.rod_radius);
    out += fmt::format("0\nTEXT\n8\nNUMBERS\n10\n{:.5f}\n20\n{:.5f}\n30\n0\n40\n{:.4f}\n1\n{}\n",
                       hinge.place.x(), hinge.place.y(), number_height_mm(sheet), hinge.number);
  }
  return out + "0\nENDSEC\n0\nEOF\n";
}

std::vector<NamedContent> write_dxf(const PrintJob& job) {
  return {{job.sheet.name + ".dxf", dxf(job.sheet, sheet_drawing(job.sheet))}};
}

}  // namespace

// Entry of the format dxf: name, meaning and writer.
const PrintFormat dxf_format = {.name = "dxf",
                                .meaning = "the same drawing for CAD and cutters",
                                .write = write_dxf,
                                .is_always_flat = true};

}  // namespace kinetix::app

#include <cairo-pdf.h>
#include <fmt/format.h>

#include "app/print/format/cut_drawing.hpp"
#include "app/print/format/print_format.hpp"
#include "app/print/format/sheet_drawing.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector2d;

/// @param closed 1 for an outline, 0 for an open line
std::string polyline(const std::vector<Vector2d>& ring, const char* layer, int closed = 1) {
  std::string out = fmt::format("0\nPOLYLINE\n8\n{}\n66\n1\n70\n{}\n10\n0\n20\n0\n30\n0\n", layer, closed);
  for (const Vector2d& p : ring)
    out += fmt::format("0\nVERTEX\n8\n{}\n10\n{:.5f}\n20\n{:.5f}\n30\n0\n", layer, p.x(), p.y());
  return out + fmt::format("0\nSEQEND\n8\n{}\n", layer);
}

std::string layer(const char* name, int colour) {
  return fmt::format("0\nLAYER\n2\n{}\n70\n0\n62\n{}\n6\nCONTINUOUS\n", name, colour);
}

std::string header(const Vector2d& low, const Vector2d& high) {
  return fmt::format(
      "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$INSUNITS\n70\n4\n"  // R12, mm
      "9\n$EXTMIN\n10\n{:.5f}\n20\n{:.5f}\n30\n0\n9\n$EXTMAX\n10\n{:.5f}\n20\n{:.5f}\n30\n0\n0\nENDSEC\n",
      low.x(), low.y(), high.x(), high.y());
}

constexpr int red = 1, blue = 5;  // colours of AutoCAD
// Layers of cut sheets, in DXF and SVG.
constexpr const char *cut_layer = "CUT", *score_layer = "SCORE";

std::string cut_dxf(const CutDrawing& drawing) {
  std::string out = header(drawing.low, drawing.high) + "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n2\n" +
                    layer(cut_layer, red) + layer(score_layer, blue) +
                    "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
  for (const auto& line : drawing.scores) out += polyline(line, score_layer, 0);
  for (const auto& slit : drawing.slits) out += polyline(slit, cut_layer, 0);
  for (const auto& ring : drawing.cuts) out += polyline(ring, cut_layer);
  return out + "0\nENDSEC\n0\nEOF\n";
}

std::string dxf(const PrintSheet& sheet, const SheetDrawing& drawing) {
  std::string out = header(drawing.low, drawing.high) + "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n4\n" +
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
  const PrintSheet& sheet = job.sheet;
  return {{sheet.name + ".dxf",
           sheet.process.cuts_sheets() ? cut_dxf(cut_drawing(sheet)) : dxf(sheet, sheet_drawing(sheet))}};
}

}  // namespace

// Entry of the format dxf: name, meaning and writer.
const PrintFormat dxf_format = {.name = "dxf",
                                .meaning = "the same drawing for CAD and cutters",
                                .write = write_dxf,
                                .is_always_flat = true};

namespace {

constexpr double line_mm = 0.1;              // mm: as laser cutters and pens draw
constexpr double points_per_mm = 72 / 25.4;  // the unit of PDF
constexpr double paper_mm[] = {210, 297};    // mm, of A4: printers often scale larger drawings down to fit.
// Length of the line to measure below such a drawing, mm. It shows 1 % with a ruler, and any printer prints it.
constexpr double check_mm = 100;
constexpr double check_foot_mm = 10;   // mm of the page, for that line and its words
constexpr double check_margin_mm = 2;  // mm, from the line to the page's edge, and of its end marks
constexpr double check_text_mm = 4;    // mm: read at arm's length

/// Page of a drawing, mm, y down. SVG has no line to measure: it also goes to cutters, which would cut the line.
struct DrawnPage {
  Vector2d size;
  std::optional<Vector2d> check = {};  ///< start of the line to measure, below the drawing
};

/// Returns a page as large as the drawing. It has a line to measure if it is larger than a sheet of paper.
DrawnPage drawn_page(const Vector2d& drawn_mm) {
  if (drawn_mm.minCoeff() <= paper_mm[0] && drawn_mm.maxCoeff() <= paper_mm[1]) return {drawn_mm};
  const double high = drawn_mm.y() + check_foot_mm;
  return {{std::max(drawn_mm.x(), check_mm + 2 * check_margin_mm), high},
          Vector2d(check_margin_mm, high - check_margin_mm)};
}

using CheckLine = std::pair<Vector2d, Vector2d>;

/// Returns the line and a mark at each of its ends.
std::array<CheckLine, 3> check_lines(const Vector2d& from) {
  const Vector2d to = from + Vector2d(check_mm, 0), up(0, -check_margin_mm);
  return {CheckLine{from, to}, CheckLine{from, from + up}, CheckLine{to, to + up}};
}

std::string check_line_text() { return fmt::format("{:g} mm, if printed at 1:1", check_mm); }

/// Returns the middle of the foot of the line's words.
Vector2d check_text_place(const Vector2d& from) {
  return from + Vector2d(check_mm / 2, -check_margin_mm / 2);
}

/// Returns the middle of a number's foot, mm: at its hinge, moved inwards if the drawing's edge would cut the number.
Vector2d number_place(const SheetDrawing& drawing, const SheetDrawing::Hinge& hinge, double height) {
  const double half = digit_share * height * static_cast<double>(std::to_string(hinge.number).size()) / 2;
  const Vector2d low = drawing.low + Vector2d(half, 0),
                 high = drawing.high - Vector2d(half, capital_share * height);
  return hinge.place.cwiseMin(high).cwiseMax(low);
}

std::string path_of(const SheetDrawing& drawing, const SheetDrawing::Part& part) {
  std::string out;
  for (const auto& ring : part.rings) {
    for (std::size_t k = 0; k < ring.size(); ++k)
      out += fmt::format("{}{:.8g} {:.8g}", k == 0 ? "M" : "L", ring[k].x() - drawing.low.x(),
                         drawing.high.y() - ring[k].y());
    out += "Z";
  }
  return out;
}

std::string group(const SheetDrawing& drawing, const char* name, const char* fill,
                  const std::vector<SheetDrawing::Part>& parts) {
  std::string out =
      fmt::format("<g id=\"{}\" fill=\"{}\" fill-rule=\"evenodd\" stroke=\"black\" stroke-width=\"{:g}\">\n",
                  name, fill, line_mm);
  for (const SheetDrawing::Part& part : parts)
    out += fmt::format("<path d=\"{}\"><title>{}</title></path>\n", path_of(drawing, part), part.name);
  return out + "</g>\n";
}

/// Draws a sheet 1:1, in the box of its parts.
std::string svg(const PrintSheet& sheet, const SheetDrawing& drawing) {
  const Vector2d size = drawing.high - drawing.low;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.8g}mm\" height=\"{1:.8g}mm\" viewBox=\"0 0 "
      "{0:.8g} {1:.8g}\">\n",
      size.x(), size.y());
  out +=
      group(drawing, "bodies", "#d9d9d4", drawing.bodies) + group(drawing, "soft", "#2e6fb7", drawing.soft);
  out += fmt::format(
      "<g id=\"numbers\" fill=\"#c03030\" font-family=\"sans-serif\" font-size=\"{:.4g}\" "
      "text-anchor=\"middle\">\n",
      number_height_mm(sheet));
  for (const SheetDrawing::Hinge& hinge : drawing.hinges) {
    const Vector2d at = number_place(drawing, hinge, number_height_mm(sheet));
    out += fmt::format("<text x=\"{:.5g}\" y=\"{:.5g}\">{}</text>\n", at.x() - drawing.low.x(),
                       drawing.high.y() - at.y(), hinge.number);
  }
  return out + "</g>\n</svg>\n";
}

cairo_status_t collect(void* text, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void draw(cairo_t* page, const SheetDrawing& drawing, const std::vector<SheetDrawing::Part>& parts,
          double grey) {
  for (const SheetDrawing::Part& part : parts) {
    for (const auto& ring : part.rings) {
      for (const Vector2d& p : ring) cairo_line_to(page, p.x() - drawing.low.x(), drawing.high.y() - p.y());
      cairo_close_path(page);
    }
    cairo_set_source_rgb(page, grey, grey, grey);
    cairo_fill_preserve(page);
    cairo_set_source_rgb(page, 0, 0, 0);
    cairo_stroke(page);
  }
}

/// Shows centred text. @param foot middle of the text's foot
void show_centred(cairo_t* page, const Vector2d& foot, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(page, text.c_str(), &extents);
  cairo_move_to(page, foot.x() - extents.x_advance / 2, foot.y());
  cairo_show_text(page, text.c_str());
}

void draw_check(cairo_t* page, const Vector2d& at) {
  cairo_set_source_rgb(page, 0, 0, 0);
  for (const auto& [from, to] : check_lines(at)) {
    cairo_move_to(page, from.x(), from.y());
    cairo_line_to(page, to.x(), to.y());
  }
  cairo_stroke(page);
  cairo_set_font_size(page, check_text_mm);
  show_centred(page, check_text_place(at), check_line_text());
}

/// Draws a page as PDF. @param drawn draws in mm, y down
std::string page_bytes(const DrawnPage& whole, const std::function<void(cairo_t*)>& drawn) {
  const Vector2d size = points_per_mm * whole.size;
  std::string out;
  const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface(
      cairo_pdf_surface_create_for_stream(collect, &out, size.x(), size.y()), &cairo_surface_destroy);
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 "2000-01-01T00:00:00Z");  // the same bytes each time
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> page(cairo_create(surface.get()), &cairo_destroy);
  cairo_scale(page.get(), points_per_mm, points_per_mm);
  cairo_set_line_width(page.get(), line_mm);
  cairo_set_fill_rule(page.get(), CAIRO_FILL_RULE_EVEN_ODD);
  cairo_select_font_face(page.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  drawn(page.get());
  if (whole.check) draw_check(page.get(), *whole.check);
  cairo_show_page(page.get());
  cairo_surface_finish(surface.get());
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error("PDF: the page cannot be drawn");
  return out;
}

}  // namespace

std::string escape_marks(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += c == '<'   ? "&lt;"
           : c == '>' ? "&gt;"
           : c == '&' ? "&amp;"
           : c == '"' ? "&quot;"
                      : std::string(1, c);
  return out;
}

std::string pdf_page(const Vector2d& drawn_mm, const std::function<void(cairo_t*)>& drawn) {
  return page_bytes(drawn_page(drawn_mm), drawn);
}

namespace {

/// Draws a sheet 1:1, on one page as large as it.
std::string pdf(const PrintSheet& sheet, const SheetDrawing& drawing) {
  return pdf_page(drawing.high - drawing.low, [&](cairo_t* page) {
    draw(page, drawing, drawing.bodies, 0.85);
    draw(page, drawing, drawing.soft, 0.5);
    cairo_set_font_size(page, number_height_mm(sheet));
    cairo_set_source_rgb(page, 0.75, 0.2, 0.2);
    for (const SheetDrawing::Hinge& hinge : drawing.hinges) {
      const Vector2d at = number_place(drawing, hinge, number_height_mm(sheet));
      show_centred(page, {at.x() - drawing.low.x(), drawing.high.y() - at.y()}, std::to_string(hinge.number));
    }
  });
}

std::string labels_svg(const char* name, const char* fill, const Strips& strips,
                       const std::vector<Strips::Label>& labels) {
  std::string out = fmt::format(
      "<g id=\"{}\" fill=\"{}\" font-family=\"sans-serif\" text-anchor=\"middle\">\n", name, fill);
  for (const Strips::Label& label : labels)
    out += fmt::format("<text x=\"{:.8g}\" y=\"{:.8g}\" font-size=\"{:.4g}\">{}</text>\n", label.place.x(),
                       strips.size.y() - label.place.y(), label.height, label.text);
  return out + "</g>\n";
}

std::string strips_svg(const Strips& strips) {
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.8g}mm\" height=\"{1:.8g}mm\" viewBox=\"0 0 "
      "{0:.8g} "
      "{1:.8g}\">\n<g id=\"cuts\" fill=\"none\" stroke=\"black\" stroke-width=\"{2:g}\">\n",
      strips.size.x(), strips.size.y(), line_mm);
  for (const auto& cut : strips.cuts) {
    out += "<path d=\"";
    for (std::size_t k = 0; k < cut.size(); ++k)
      out += fmt::format("{}{:.8g} {:.8g}", k == 0 ? "M" : "L", cut[k].x(), strips.size.y() - cut[k].y());
    out += "Z\"/>\n";
  }
  out += fmt::format(
      "</g>\n<g id=\"folds\" stroke=\"#2e6fb7\" stroke-width=\"{0:g}\" stroke-dasharray=\"1 0.5\">\n",
      line_mm);
  for (const auto& [from, to] : strips.folds)
    out += fmt::format("<line x1=\"{:.8g}\" y1=\"{:.8g}\" x2=\"{:.8g}\" y2=\"{:.8g}\"/>\n", from.x(),
                       strips.size.y() - from.y(), to.x(), strips.size.y() - to.y());
  return out + "</g>\n" + labels_svg("numbers", "#c03030", strips, strips.numbers) +
         labels_svg("vertices", "#606060", strips, strips.vertices) + "</svg>\n";
}

void draw_labels(cairo_t* page, const Strips& strips, const std::vector<Strips::Label>& labels) {
  for (const Strips::Label& label : labels) {
    cairo_set_font_size(page, label.height);
    show_centred(page, {label.place.x(), strips.size.y() - label.place.y()}, label.text);
  }
}

std::string strips_pdf(const Strips& strips) {
  return pdf_page(strips.size, [&](cairo_t* page) {
    const auto line_to = [&](const Vector2d& p) { cairo_line_to(page, p.x(), strips.size.y() - p.y()); };
    for (const auto& cut : strips.cuts) {
      for (const Vector2d& p : cut) line_to(p);
      cairo_close_path(page);
    }
    cairo_stroke(page);
    cairo_set_source_rgb(page, 0.18, 0.435, 0.718);
    for (const auto& [from, to] : strips.folds) {
      cairo_new_sub_path(page);
      line_to(from);
      line_to(to);
    }
    cairo_stroke(page);
    cairo_set_source_rgb(page, 0.75, 0.2, 0.2);
    draw_labels(page, strips, strips.numbers);
    cairo_set_source_rgb(page, 0.4, 0.4, 0.4);
    draw_labels(page, strips, strips.vertices);
  });
}

constexpr double hairline_mm = 0.01;  // mm: cutters follow thinner lines, and engrave thicker ones

/// Returns the lines of a cut sheet. @param end of each path: "Z" if closed
std::string lines_svg(const CutDrawing& drawing, const std::vector<std::vector<Vector2d>>& lines,
                      const char* end) {
  std::string out;
  for (const auto& line : lines) {
    out += "<path d=\"";
    for (std::size_t k = 0; k < line.size(); ++k)
      out += fmt::format("{}{:.8g} {:.8g}", k == 0 ? "M" : "L", line[k].x() - drawing.low.x(),
                         drawing.high.y() - line[k].y());
    out += fmt::format("{}\"/>\n", end);
  }
  return out;
}

std::string layer_svg(const char* id, const char* colour, const std::string& lines) {
  return fmt::format("<g id=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:g}\">\n", id, colour,
                     hairline_mm) +
         lines + "</g>\n";
}

std::string cut_svg(const CutDrawing& drawing) {
  const Vector2d size = drawing.high - drawing.low;
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.8g}mm\" height=\"{1:.8g}mm\" viewBox=\"0 "
             "0 "
             "{0:.8g} {1:.8g}\">\n",
             size.x(), size.y()) +
         layer_svg(score_layer, "#0000ff", lines_svg(drawing, drawing.scores, "")) +
         layer_svg(cut_layer, "#ff0000",
                   lines_svg(drawing, drawing.slits, "") + lines_svg(drawing, drawing.cuts, "Z")) +
         "</svg>\n";
}

/// Draws a cut sheet 1:1. It has no line to measure, which a cutter would cut.
std::string cut_pdf(const CutDrawing& drawing) {
  return page_bytes({drawing.high - drawing.low}, [&](cairo_t* page) {
    cairo_set_line_width(page, hairline_mm);
    const auto draw_line = [&](const std::vector<Vector2d>& line) {
      cairo_new_sub_path(page);
      for (const Vector2d& p : line) cairo_line_to(page, p.x() - drawing.low.x(), drawing.high.y() - p.y());
    };
    cairo_set_source_rgb(page, 0, 0, 1);
    for (const auto& line : drawing.scores) draw_line(line);
    cairo_stroke(page);
    cairo_set_source_rgb(page, 1, 0, 0);
    for (const auto& slit : drawing.slits) draw_line(slit);
    for (const auto& ring : drawing.cuts) {
      draw_line(ring);
      cairo_close_path(page);
    }
    cairo_stroke(page);
  });
}

std::vector<NamedContent> write_svg(const PrintJob& job) {
  const PrintSheet& sheet = job.sheet;
  if (sheet.process.cuts_sheets()) {
    const CutDrawing cut = cut_drawing(sheet);
    return {{sheet.name + ".svg", cut_svg(cut)}, {sheet.name + ".pdf", cut_pdf(cut)}};
  }
  const SheetDrawing drawing = sheet_drawing(sheet);
  std::vector<NamedContent> files{{sheet.name + ".svg", svg(sheet, drawing)},
                                  {sheet.name + ".pdf", pdf(sheet, drawing)}};
  if (sheet.kind() != model::HingeKind::film) return files;
  const Strips cards = strips(sheet);
  files.push_back({sheet.name + "_strips.svg", strips_svg(cards)});
  files.push_back({sheet.name + "_strips.pdf", strips_pdf(cards)});
  return files;
}

}  // namespace

// Entry of the format svg: name, meaning and writer.
const PrintFormat svg_format = {.name = "svg",
                                .meaning = "a drawing 1:1 with numbered hinges, and the same as PDF",
                                .write = write_svg,
                                .is_always_flat = true};

}  // namespace kinetix::app

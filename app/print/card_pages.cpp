#include <cairo.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/print/folding_card.hpp"
#include "app/print/format/sheet_drawing.hpp"

namespace kinetix::app {
namespace {

using Eigen::Vector2d;
using Ring = std::vector<Vector2d>;

constexpr double label_mm = 3.5, caption_mm = 3.8, title_mm = 7,
                 line_of_text_mm = 5.6;                                       // mm: read at arm's length
constexpr double page_mm[] = {210, 297}, page_margin_mm = 15, words_mm = 22;  // mm, of A4

constexpr double units_per_mm = 100;  // 1/mm: whole units make pictures half as long as decimals

/// Returns the outlines in units of a picture, each point relative to the one before.
std::string path_data(const CardPicture::Shape& shape) {
  std::string out;
  for (const Ring& ring : shape.rings) {
    Eigen::Vector2i last(0, 0);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Eigen::Vector2i at = (units_per_mm * ring[k]).array().round().cast<int>();
      out += fmt::format("{}{}{}{}",
                         k == 0   ? "M"
                         : k == 1 ? "l"
                                  : " ",
                         at.x() - last.x(), at.y() < last.y() ? "" : " ", at.y() - last.y());
      last = at;
    }
    if (!shape.fill.empty()) out += "Z";
  }
  return out;
}

std::string picture_svg(const CardPicture& picture) {
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" width=\"{:.5g}mm\" "
      "role=\"img\" aria-label=\"{}\" fill-rule=\"evenodd\" stroke-linejoin=\"round\">",
      units_per_mm * picture.size.x(), units_per_mm * picture.size.y(), picture.size.x(),
      escape_marks(picture.caption));
  for (const CardPicture::Shape& shape : picture.shapes)
    out +=
        fmt::format("<path d=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{:g}\"/>\n", path_data(shape),
                    shape.fill.empty() ? "none" : shape.fill, shape.stroke, units_per_mm * shape.stroke_mm);
  for (const CardPicture::Label& label : picture.labels)
    out += fmt::format(
        "<text x=\"{:.0f}\" y=\"{:.0f}\" font-size=\"{:g}\" text-anchor=\"middle\" "
        "font-family=\"sans-serif\">"
        "{}</text>",
        units_per_mm * label.foot.x(), units_per_mm * label.foot.y(), units_per_mm * label_mm,
        escape_marks(label.text));
  return out + "</svg>";
}

void set_colour(cairo_t* page, const std::string& colour) {
  const unsigned long rgb = std::stoul(colour.substr(1), nullptr, 16);
  const auto part = [&](int shift) { return static_cast<double>(rgb >> shift & 0xff) / 0xff; };
  cairo_set_source_rgb(page, part(16), part(8), part(0));
}

void show_at(cairo_t* page, const Vector2d& foot, const std::string& text) {
  cairo_move_to(page, foot.x(), foot.y());
  cairo_show_text(page, text.c_str());
}

double width_of(cairo_t* page, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(page, text.c_str(), &extents);
  return extents.x_advance;
}

void draw_picture(cairo_t* page, const CardPicture& picture, const Vector2d& at) {
  for (const CardPicture::Shape& shape : picture.shapes) {
    for (const Ring& ring : shape.rings) {
      cairo_new_sub_path(page);
      for (const Vector2d& p : ring) cairo_line_to(page, at.x() + p.x(), at.y() + p.y());
      if (!shape.fill.empty()) cairo_close_path(page);
    }
    if (!shape.fill.empty()) {
      set_colour(page, shape.fill);
      cairo_fill_preserve(page);
    }
    set_colour(page, shape.stroke);
    cairo_set_line_width(page, shape.stroke_mm);
    cairo_stroke(page);
  }
  cairo_set_font_size(page, label_mm);
  set_colour(page, "#000000");
  for (const CardPicture::Label& label : picture.labels)
    show_at(page, at + label.foot - Vector2d(width_of(page, label.text) / 2, 0), label.text);
}

/// Shows text in lines no longer than the page allows. @return the foot of the next line, mm
double show_lines(cairo_t* page, const std::string& text, double left, double foot) {
  std::string line, word;
  const auto add_word = [&] {
    const std::string longer = line.empty() ? word : line + " " + word;
    if (left + width_of(page, longer) > page_mm[0] - page_margin_mm) {
      show_at(page, {left, foot}, line);
      foot += line_of_text_mm;
      line = word;
    } else {
      line = longer;
    }
    word.clear();
  };
  for (const char c : text) {
    if (c == ' ')
      add_word();
    else
      word += c;
  }
  add_word();
  show_at(page, {left, foot}, line);
  return foot + line_of_text_mm;
}

void draw_card(cairo_t* page, const FoldingCard& card) {
  double foot = page_margin_mm + title_mm;
  cairo_set_font_size(page, title_mm);
  show_at(page, {page_margin_mm, foot}, "How to fold " + card.name);
  for (const CardPicture& picture : card.pictures) {
    draw_picture(page, picture, {(page_mm[0] - picture.size.x()) / 2, foot});
    foot += picture.size.y() + caption_mm;
    cairo_set_font_size(page, caption_mm);
    foot = show_lines(page, picture.caption, page_margin_mm, foot);
  }
  foot += line_of_text_mm;
  for (const auto& [title, how] : card.steps) {
    show_at(page, {page_margin_mm, foot}, title);
    foot = show_lines(page, how, page_margin_mm + words_mm, foot);
  }
}

/// Returns pictures and steps as HTML.
std::string card_part(const FoldingCard& card) {
  std::string out;
  for (const CardPicture& picture : card.pictures)
    out += fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", picture_svg(picture),
                       escape_marks(picture.caption));
  out += "<ol>\n";
  for (const auto& [title, how] : card.steps)
    out += fmt::format("<li><strong>{}.</strong> {}</li>\n", title, escape_marks(how));
  return out + "</ol>\n";
}

}  // namespace

nlohmann::ordered_json card_json(const FoldingCard& card) {
  nlohmann::ordered_json pictures = nlohmann::ordered_json::array();
  for (const CardPicture& picture : card.pictures)
    pictures.push_back({{"svg", picture_svg(picture)}, {"caption", picture.caption}});
  return {{"pictures", pictures}, {"steps", card.steps}};
}

std::vector<NamedContent> card_files(const FoldingCard& card) {
  const std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>How to fold "
      "{0}</title>\n"
      "<style>\nbody {{ max-width: 180mm; margin: 10mm auto; padding: 0 4mm; font: 12pt/1.4 sans-serif; }}\n"
      "figure {{ margin: 0; text-align: center; }}\nsvg {{ max-width: 100%; height: auto; }}\n"
      "li {{ margin: 1ex 0; }}\n@page {{ size: A4; margin: 10mm; }}\n</style>\n</head>\n<body>\n"
      "<h1>How to fold {0}</h1>\n{1}</body>\n</html>\n",
      escape_marks(card.name), card_part(card));
  const std::string pdf = pdf_page({page_mm[0], page_mm[1]}, [&](cairo_t* drawn) { draw_card(drawn, card); });
  return {{"card.html", page}, {"card.pdf", pdf}};
}

}  // namespace kinetix::app

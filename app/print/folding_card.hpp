#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/print/format/print_format.hpp"

namespace kinetix::app {

/// Picture on a page, mm, y down.
struct CardPicture {
  /// Filled outlines, or lines if `fill` is empty. Colours are "#rrggbb".
  struct Shape {
    std::vector<std::vector<Eigen::Vector2d>> rings;
    std::string fill;
    std::string stroke;
    double stroke_mm;
  };
  /// Text centred above its foot.
  struct Label {
    Eigen::Vector2d foot;
    std::string text;
  };

  Eigen::Vector2d size = {0, 0};
  std::vector<Shape> shapes = {};
  std::vector<Label> labels = {};
  std::string caption = {};
};

/// Page for the one who folds a printed sheet: pictures with arrows, and steps in words.
struct FoldingCard {
  std::string name;
  std::vector<CardPicture> pictures;              ///< flat, to scale, and folded if the fold is known
  std::vector<std::array<std::string, 2>> steps;  ///< what to do, in one or two words, and how
};

/// Makes the card of a job with its folding (PrintJob::folding).   @pre not imported bodies
FoldingCard make_folding_card(const PrintJob& job);

/// Returns the card for a page that draws it: `pictures` with `svg` and `caption`, and `steps`, pairs of texts.
nlohmann::ordered_json card_json(const FoldingCard& card);
/// Returns card.html and card.pdf. The PDF is one page of A4.
std::vector<NamedContent> card_files(const FoldingCard& card);

}  // namespace kinetix::app

#include "benchmarks/speed_error/series_style.hpp"

#include <fmt/format.h>

#include <map>

namespace kinetix::bench {
namespace {

// One colour a family of methods; its series differ by their marks.
constexpr const char* green = "#1a7f37";
constexpr const char* blue = "#0969da";

// Styles by the name of the series; other series get a default style below.
const std::map<std::string, SeriesStyle> styles = {
    {"exact", {"#1f2328", Marker::diamond}},
    {"equilibrium", {green, Marker::triangle}},
    {"Bullet, direct", {blue, Marker::circle}},
    {"Bullet, direct, single precision", {blue, Marker::ring, true}}};

std::string outline(Marker marker, double x, double y) {
  switch (marker) {
    case Marker::circle:
    case Marker::ring:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"", x, y);
    case Marker::triangle:
      return fmt::format("<path d=\"M{:.1f},{:.1f}l3.6,6.2h-7.2z\"", x, y - 3.8);
    case Marker::diamond:
      break;
  }
  return fmt::format("<path d=\"M{:.1f},{:.1f}l5,6l-5,6l-5,-6z\"", x, y - 6);
}

bool is_hollow(Marker marker) { return marker == Marker::ring; }

}  // namespace

SeriesStyle style_of(const std::string& series) {
  const auto known = styles.find(series);
  return known == styles.end() ? SeriesStyle{"#8250df", Marker::triangle} : known->second;
}

std::string svg_marker(const SeriesStyle& style, double x, double y, double opacity) {
  const std::string paint =
      is_hollow(style.marker)
          ? fmt::format("fill=\"#ffffff\" stroke=\"{}\" stroke-width=\"1.2\"", style.colour)
          : fmt::format("fill=\"{}\"", style.colour);
  const std::string veil = opacity < 1 ? fmt::format(" opacity=\"{:g}\"", opacity) : "";
  return fmt::format("{} {}{}/>\n", outline(style.marker, x, y), paint, veil);
}

}  // namespace kinetix::bench

#pragma once

#include "app/exports/exporter.hpp"

namespace kinetix::app {

/// What every run writes, in this order.
const std::vector<const Exporter*>& exporters();

/// Adds an exporter, for programs that link this library. Not while others read the list.
/// @param exporter must outlive all use; no other one writes files of its names
void add_exporter(const Exporter& exporter);

}  // namespace kinetix::app

#pragma once

#include "app/exports/exporter.hpp"

namespace kinetix::app {

/// report.html: one page that shows the result and needs no other file.
extern const Exporter report_export;

}  // namespace kinetix::app

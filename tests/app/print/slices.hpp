#pragma once

#include <string>

namespace kinetix::testing {

/// Connected pieces of what an SLA archive (one PNG a layer) would print: pixels that share an edge within a layer, or
/// lie over each other in two. @param swelling_px by which all is made larger in each layer first
int printed_pieces(const std::string& archive, int swelling_px = 0);

}  // namespace kinetix::testing

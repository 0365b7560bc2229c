// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "resource/schema.h"

#include <string>
#include <vector>

namespace terrane {

struct ManualPage {
    std::string file; ///< "textures.md"; the first page is README.md
    std::string text; ///< Markdown, with links to the other pages
};

/// The reference manual: an index, and a page for each chapter of the registry that has types. What
/// was declared without a chapter stands on a page "Others".
std::vector<ManualPage> writeManual(const Schema& schema);

} // namespace terrane

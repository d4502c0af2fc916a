// Schemas of the formats, with which editors complete and check files, and tables of them for the reference.
#pragma once

#include <string>

#include "core/types/registry.h"

namespace forage::xml {

/// A RELAX NG grammar of .iqr and .iqrProcess files, made from their tables and the types of `registry`:
/// elements, attributes and their ranges, and for each type its parameters and cross references, with their
/// documentation.
std::string relax_ng(const Registry& registry);

/// A RELAX NG grammar of experiment files.
std::string relax_ng_of_experiments();

/// The elements of system files and the types of `registry` as Markdown: for each of them a table between
/// "<!-- table: NAME -->" and "<!-- end -->". docs/reference holds these tables.
std::string markdown_tables(const Registry& registry);

}  // namespace forage::xml

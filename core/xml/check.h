// Documents are read by the table of their format: what is not in it, or missing, is reported with a hint.
#pragma once

#include <memory>
#include <string>

#include "core/xml/document.h"
#include "core/xml/rules.h"

namespace forage::xml {

/// Reads the file at `path`. Reports why it cannot be read, what keeps it from being well-formed XML, or that
/// it is of another kind than `format`, and returns null then.
std::unique_ptr<const Document> open(const std::string& path, const Format& format, Diagnostics& diagnostics);
/// The same for a text that users know as the file `path`.
std::unique_ptr<const Document> open(const std::string& path, std::string text, const Format& format,
                                     Diagnostics& diagnostics);

/// Reports all elements and attributes of a document that its format does not have, that are missing, or
/// whose values are wrong. Returns whether a model can be made of the document that is wrong only where that
/// was reported, so that it is worth checking further.
bool check(const Document& document, const Format& format, Diagnostics& diagnostics);
/// The same for an element whose place in the document is checked already.
bool check(const Element& element, const ElementRule& rule, const Format& format, Diagnostics& diagnostics);

}  // namespace forage::xml

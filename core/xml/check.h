// Checks documents against the table of their format. What is unknown or missing is reported with a hint.
#pragma once

#include <memory>
#include <string>

#include "core/xml/document.h"
#include "core/xml/rules.h"

namespace forage::xml {

/// Reads the file at `path`. Reports an error and returns null when it cannot be read, is not well-formed
/// XML, or is not of the kind `format`. `used` is where another file uses this one (SourceFile::used).
std::unique_ptr<const Document> open(const std::string& path, const Format& format, Diagnostics& diagnostics,
                                     std::string used = {});
/// Reads a text as open() reads a file; messages call it `path`.
std::unique_ptr<const Document> open(const std::string& path, std::string text, const Format& format,
                                     Diagnostics& diagnostics, std::string used = {});

/// Reports all elements and attributes of a document that its format does not have, that are missing, or
/// whose values are wrong. Returns whether a model can be built from the document for further checks, wrong
/// only in what was reported.
bool check(const Document& document, const Format& format, Diagnostics& diagnostics);
/// Checks an element as check() does a document. Its place in the document must have been checked before.
bool check(const Element& element, const ElementRule& rule, const Format& format, Diagnostics& diagnostics);

}  // namespace forage::xml

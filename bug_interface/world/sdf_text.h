// What has to be done with the text of an SDF file because the library is too obliging.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace forage::bug {

/// The name of the first element of an XML text; empty when there is none.
std::string root_name(std::string_view text);

/// The text with a mark before every <uri>. The library looks for what is included among its own files and in
/// the working directory first, and follows a file that includes itself for ever; what is marked it finds
/// nowhere.
std::string with_marked_uris(std::string_view text);
/// A <uri> without the mark.
std::string without_mark(std::string uri);

/// Calls `bad(offset, value)` for every element whose name `is_number` and that holds what is no number or
/// list of numbers: the library reads "1,5" as 1 and "3m" as 3.
void find_bad_numbers(std::string_view text, const std::function<bool(std::string_view name)>& is_number,
                      const std::function<void(std::size_t offset, std::string_view value)>& bad);

}  // namespace forage::bug

// SPDX-License-Identifier: MIT
// Whether text is XML that any program reads, for tests of what strut draws.
#pragma once

#include <string>

namespace strut::test {

/// Why `text` is not one well-formed XML element: tags that do not nest, attributes twice or without quotes, characters
/// that must be spelt out, an id that is used and not there. Empty if it is. No declarations or comments are allowed.
std::string xml_error(const std::string& text);

}  // namespace strut::test

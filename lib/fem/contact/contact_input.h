// The surfaces of a contact in the input.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "lib/config/spec.h"
#include "lib/fem/block_pattern.h"
#include "lib/fem/contact/contact_surface.h"

namespace orthodyn {

// The surface with this name, or the whole outer surface of the region with this name. Throws ConfigError at `origin`.
// The middles of its faces are numbered from `first_middle` on, by default after the nodes.
ContactSurface contact_surface(const Mesh& mesh, const std::string& name, const SourceLocation& origin,
                               std::optional<int> first_middle = {});

// Throws ConfigError if two surfaces share nodes.
void require_apart(const ContactSurface& first, const ContactSurface& second, const std::array<std::string, 2>& names,
                   const SourceLocation& origin);

// All pairs of nodes of both surfaces, or those of a surface with itself, that are at most `slide` (m) apart at rest.
// Throws ConfigError if there are too many.
NodePairs contact_couplings(const Mesh& mesh, const ContactSurface& first, const ContactSurface& second,
                            std::optional<double> slide, const SourceLocation& origin);

}  // namespace orthodyn

// `orthodyn list --markdown`: every key of the input on one page, docs/reference.md.
#pragma once

namespace orthodyn {

void print_reference_page();

}  // namespace orthodyn

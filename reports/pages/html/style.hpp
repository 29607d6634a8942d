#pragma once

namespace reports {

/// The page's style sheet: one column beside its contents, light and dark, narrow windows, print.
const char* page_style();
/// The page's script: search, filters, links into folded parts. The page is whole without it.
const char* page_script();

}  // namespace reports

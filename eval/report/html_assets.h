#pragma once

namespace dressform {

// The look of report pages: light, dark, phone and paper.
extern const char* const kPageStyle;
// What makes comparisons flip and slide, and models turn. Pages show all pictures and numbers without it.
extern const char* const kPageScript;
// Nothing of a page may ask for anything: only what is inside it is shown and run.
extern const char* const kPagePolicy;

}  // namespace dressform

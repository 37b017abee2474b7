// What scrolls sideways can be reached by the keyboard, in browsers too that do not see to it.
const look = new ResizeObserver((parts) => {
  for (const { target } of parts) {
    if (target.scrollWidth > target.clientWidth) target.tabIndex = 0;
    else target.removeAttribute("tabindex");
  }
});
for (const part of document.querySelectorAll("pre, .table-wrapper, div.math, .cell_output .output")) look.observe(part);

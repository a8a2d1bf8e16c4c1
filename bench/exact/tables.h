#pragma once

namespace heddle::bench {

/// Each function prints one section of bench/results/exact.md, as markdown, to stdout.
void print_isolated_fibers();
void print_bundles();
void print_leaf_fits();
void print_volumes();

} // namespace heddle::bench

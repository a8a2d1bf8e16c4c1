"""What `tools/compare` and the protocols in `bench/` share: reading pictures, errors between them,
tables, plots."""

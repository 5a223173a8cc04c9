"""What the engine costs, in ratios measured in one run. `python -m benchmarks`; README.md beside this file."""

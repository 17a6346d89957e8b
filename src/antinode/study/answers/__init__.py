"""Questions to a sweep that is done: shares, worst cases, quantiles, figures, searches."""

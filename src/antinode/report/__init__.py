"""Reports: a case, a beam or a study as a document for a reviewer, in HTML or PDF."""

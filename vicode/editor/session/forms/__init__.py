"""Forms of the items of a design: their content, and the edits that the browser makes in them."""

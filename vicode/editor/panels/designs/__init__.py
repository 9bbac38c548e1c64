"""Lists of designs, and dialogs that create, copy and delete them."""

"""How designs are said in XABSL: by which names, and what of them it cannot say."""

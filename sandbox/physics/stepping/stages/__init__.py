"""What only some levels call for in a step, one stage a file; `register.py` lists them."""

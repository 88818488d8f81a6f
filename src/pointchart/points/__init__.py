"""Points: made ready, their neighbours, what is around them."""

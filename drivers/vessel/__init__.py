"""From the surface of a lumen to a beat that repeats itself: the parts of tunica-vessel."""

"""Reading, drawing and composing for tunica-report."""

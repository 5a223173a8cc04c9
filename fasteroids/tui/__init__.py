"""The game in the terminal: a pure core, and a thin shell around it that alone knows textual."""

"""What both widgets of the game are: lines of text, made one by one, each kept as long as it is shown.

Textual gives a widget's lines borders, padding, opacity and more, at every refresh of each, which is a third of what a
frame costs. These widgets have nothing of that, so their lines go to the screen as they are.
"""

from __future__ import annotations

from textual.geometry import Region
from textual.strip import Strip
from textual.widget import Widget

__all__ = ["Lines"]


class Lines(Widget):
    """A widget that is what its `render_line` gives, as wide as it is. Of its styles only size and place do something.

    A line that stays should stay the same strip: Textual keeps in it what it made of it.
    """

    def render_lines(self, crop: Region) -> list[Strip]:
        """The lines in sight. What filters colours (NO_COLOR) does so here as elsewhere."""
        strips = [self.render_line(y) for y in crop.line_range]
        _, background = self.background_colors
        for each in self.get_line_filters():
            strips = [strip.apply_filter(each, background) for strip in strips]
        if crop.column_span != (0, self.outer_size.width):
            return [strip.crop(*crop.column_span) for strip in strips]
        return strips

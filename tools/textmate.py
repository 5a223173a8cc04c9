"""Write the TextMate grammar: ``python tools/textmate.py > editors/vscode/syntaxes/fasteroids.tmLanguage.json``.

The rules are those of `fasteroids.highlight`, and so the words those of `fasteroids.lang.words`.
"""

from __future__ import annotations

import json

from fasteroids.highlight import RULES

SCOPE = "source.fasteroids"


def grammar() -> str:
    """The grammar as the text of its file."""
    patterns = [
        {"name": "%s.fasteroids" % rule.scope, "match": rule.pattern}
        for rule in RULES
        if rule.scope
    ]
    whole = {
        "information_for_contributors": [
            "Written by tools/textmate.py: change that, not this file."
        ],
        "name": "Fasteroids",
        "scopeName": SCOPE,
        "fileTypes": ["ast"],
        "patterns": patterns,
    }
    return json.dumps(whole, indent=2, ensure_ascii=True) + "\n"


if __name__ == "__main__":
    print(grammar(), end="")

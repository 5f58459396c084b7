"""What has no counterpart: where it stands, what it means there, what was done here."""
import textwrap

from . import keys

ZEROS = ("0", "0.0", "0.", "false")


class Notes:
    def __init__(self):
        self.rows = []

    def add(self, place, meaning, done):
        if (place, meaning, done) not in self.rows:
            self.rows.append((place, meaning, done))

    def of_key(self, node, key, meaning, done):
        text = node.word(key)
        self.add(f"{node.place} / {key}" + (f" = {text}" if text else ""), meaning, done)

    def rest(self, root):
        """What nobody has read, unless it changes nothing; a key that several elements have is one row."""
        places = {}
        for place, key, text in root.left():
            if key in keys.SILENT or (text or "").lower() in ZEROS:
                continue
            meaning, done = keys.MEANING.get(key, ("unknown to tunica-import" if text is None else "", "left out"))
            places.setdefault((key, meaning, done), []).append((place, text))
        for (key, meaning, done), found in places.items():
            texts = {text for _, text in found if text and len(text) < 40}
            value = f" = {texts.pop()}" if len(texts) == 1 else ""
            where = ", ".join(dict.fromkeys(place for place, _ in found if place))
            self.add((f"{where} / " if where else "") + key + value, meaning, done)

    def texts(self):
        for place, meaning, done in self.rows:
            yield f"{place}. " + (f"There: {meaning}. " if meaning else "") + f"Here: {done}."

    def lines(self):
        """For the screen."""
        if not self.rows:
            return
        yield f"no counterpart, {len(self.rows)}:"
        for text in self.texts():
            yield from textwrap.wrap(text, 118, initial_indent="  ", subsequent_indent="      ")

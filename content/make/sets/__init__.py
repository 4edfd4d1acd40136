"""Parts for scenes that exist to be measured, and should still look like places: shells of rooms, fixtures,
furniture, small textures. Lighter than the gallery's, so that such a scene stays under 300 KiB."""

"""The pages of the side panel, a folder each: what it computes, its card, its panel."""

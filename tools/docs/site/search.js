/* Searching forgives a typo, and finds an error by its symptoms. WORDS, those of the site, the most
 * frequent first, and SYMPTOMS, of each error a list, are in words.js, of tools/docs/document.py. */
"use strict";

/* Letters left out, put in, changed or swapped with the next one, up to a limit. */
const typos = (a, b, limit) => {
  if (Math.abs(a.length - b.length) > limit) return limit + 1;
  let above, before = [], row = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; i++) {
    [above, before, row] = [before, row, [i]];
    for (let j = 1; j <= b.length; j++) {
      row[j] = Math.min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (a[i - 1] !== b[j - 1]));
      if (i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1])
        row[j] = Math.min(row[j], above[j - 2] + 1);
    }
  }
  return row[b.length];
};

const stem = (word) => new Stemmer().stemWord(word.toLowerCase());

/* The word of the site that is meant: itself, where a page has it or something that it is part of. */
const meant = (word) => {
  const lower = word.toLowerCase();
  if (lower.length < 4 || Object.hasOwn(Search._index.terms, stem(word))
      || WORDS.some((known) => known.includes(lower))) return word;
  let best = word, least = lower.length < 6 ? 1 : 2;
  for (const known of WORDS) {
    const count = typos(lower, known, least);
    if (count < least || (count === least && best === word)) [best, least] = [known, count];
  }
  return best;
};

/* Does a search ask for a symptom: for more than half of its words and no other, or for all? */
const asks = (query, symptom) => {
  const stems = (text) => new Set(splitQuery(text).map(stem));
  const asked = stems(query), told = stems(symptom);
  const common = [...told].filter((word) => asked.has(word)).length;
  return common === told.size || (common === asked.size && 2 * common > told.size);
};

const { query: search, _performSearch: find } = Search;
Search.query = (text) => {
  const mended = text.replace(/[\p{Letter}\p{Number}_]+/gu, meant);
  if (mended !== text) {
    const told = document.createElement("p");
    told.id = "search-meant";
    told.textContent = `Searched for: ${mended}`;
    Search.title.after(told);
  }
  search(mended);
};
Search._performSearch = (query, ...rest) => {
  const errors = Object.entries(SYMPTOMS).flatMap(([word, symptoms]) => {
    const symptom = symptoms.find((one) => asks(query, one));
    return symptom ? [["docs/errors", word, `#${word}`, symptom, 1000, "", SearchResultKind.title]]
                   : [];
  });
  // The last one is shown first. A parameter of a function stands beside it.
  const found = find(query, ...rest).filter((item) => !item[3]?.startsWith("C function parameter"));
  return [...found, ...errors.reverse()];
};
// Pages cannot be read by a script without a server.
if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;

// Titles of cycles, names of alarms and sentences about a run in the reader's language. The record of a run is in
// English; src/words/words.cpp does the same for the terminal.

import phrases from "./texts/phrases.json";
import { currentLanguage } from "./language";

const columns = ["de", "ru", "sv", "zh", "pl"];

interface Pattern {
  form: RegExp;
  words: string[];
  length: number;
}

const exact = { ...phrases } as Record<string, string[]>;
let patterns: Pattern[] | null = null;

/** Phrases with places for values, the ones with the most words in them first. */
function allPatterns(): Pattern[] {
  patterns ??= Object.entries(exact)
    .filter(([english]) => english.includes("{0}"))
    .map(([english, words]) => {
      const pieces = english.split(/\{\d\}/);
      const form = new RegExp(`^${pieces.map((piece) => piece.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")).join("(.+?)")}$`, "s");
      return { form, words, length: pieces.join("").length };
    })
    .sort((a, b) => b.length - a.length);
  return patterns;
}

function known(english: string, column: number): string | undefined {
  if (Object.hasOwn(exact, english)) return exact[english][column];
  for (const { form, words } of allPatterns()) {
    const found = form.exec(english);
    if (found) return words[column].replace(/\{(\d)\}/g, (_, place) => translated(found[Number(place) + 1]));
  }
  return undefined;
}

/** Phrases of the page's own cycles, which the table does not have. */
export function usePhrases(own: Record<string, string[]>) {
  Object.assign(exact, own);
  patterns = null;
}

let described: Record<string, string[]> = {};

/** The words of the page for what its calls say of their parameters. */
export function useDescriptions(words: Record<string, string[]>) {
  described = words;
}

/** What a parameter means. */
export function description(english: string): string {
  const column = columns.indexOf(currentLanguage());
  return column >= 0 && Object.hasOwn(described, english) ? described[english][column] : english;
}

/** A phrase that the table has word for word: of a result it says more than its quantity does. */
export function exactly(english: string): string | undefined {
  const column = columns.indexOf(currentLanguage());
  return column >= 0 && Object.hasOwn(exact, english) ? exact[english][column] : undefined;
}

/** A text as a whole, which may be a program's own words; what the table does not know stays as it is. */
export function phrase(english: string): string {
  const column = columns.indexOf(currentLanguage());
  return (column < 0 ? undefined : known(english, column)) ?? english;
}

/** The same, of "NAME: sentence" each part for itself, of "Hole 40" the word before its size. */
export function translated(english: string): string {
  const column = columns.indexOf(currentLanguage());
  if (column < 0) return english;
  // What an alarm of this run says.
  if (Object.hasOwn(described, english)) return described[english][column];
  const colon = english.indexOf(": ");
  const name = english.slice(0, colon);
  // The name of an alarm first: else what it says would be taken for a value of some sentence.
  if (colon >= 0 && Object.hasOwn(exact, name)) return `${exact[name][column]}: ${translated(english.slice(colon + 2))}`;
  const whole = known(english, column);
  if (whole !== undefined) return whole;
  if (colon < 0) {
    // A feature with its size.
    const [, feature = "", size = ""] = /^([^0-9]+)( [0-9].*)$/s.exec(english) ?? [];
    return Object.hasOwn(exact, feature) ? exact[feature][column] + size : english;
  }
  return `${known(name, column) ?? name}: ${translated(english.slice(colon + 2))}`;
}

// The page's texts in the reader's language. One table a language in texts/; English says which keys there are.

import de from "./texts/de.json";
import en from "./texts/en.json";
import pl from "./texts/pl.json";
import ru from "./texts/ru.json";
import sv from "./texts/sv.json";
import zh from "./texts/zh.json";

type Plural = Partial<Record<Intl.LDMLPluralRule, string>> & { other: string };
type English = typeof en;
export type Key = keyof English;
/** A table of another language: no key may lack, and what has a plural in English has one there. */
export type Texts = { [K in Key]: English[K] extends string ? string : Plural };

export const tables = { en, de, ru, sv, zh, pl } satisfies Record<string, Texts>;
export type Language = keyof typeof tables;
export const languageNames: Record<Language, string> = {
  en: "English",
  de: "Deutsch",
  ru: "Русский",
  sv: "Svenska",
  zh: "中文",
  pl: "Polski",
};

let language: Language = "en";
let plurals = new Intl.PluralRules("en");

export const currentLanguage = (): Language => language;

/** Unknown codes mean English. */
export function useLanguage(code: string) {
  language = code in tables ? (code as Language) : "en";
  plurals = new Intl.PluralRules(language);
}

type Values = Record<string, string | number>;

/** The text of `key`, with values in place of {names}; `n` decides about singular and plural. */
export function t(key: Key, values: Values = {}): string {
  const entry: string | Plural = tables[language][key];
  const text = typeof entry === "string" ? entry : (entry[plurals.select(Number(values.n))] ?? entry.other);
  return text.replace(/\{(\w+)\}/g, (whole, name) => (name in values ? String(values[name]) : whole));
}

/** The text of a key that is put together, such as a quantity's name; nothing if there is none. */
export function maybe(key: string): string | undefined {
  const entry = (tables[language] as Record<string, string | Plural>)[key];
  return typeof entry === "string" ? entry : undefined;
}

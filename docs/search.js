// The search of the site: all sections by lunr, in the page.
"use strict";
{
    const field = document.getElementById("search"), list = document.getElementById("found");
    const most = 12;
    let index;

    const build = () => lunr(function () {
        this.ref("id");
        this.field("heading", { boost: 8 });
        this.field("page", { boost: 3 });
        this.field("words");
        // Names of the code are found whole and by their parts.
        const parts = (text) => text + " " + text.replace(/[_\-/.()`]+/g, " ");
        // What is explained goes before what is only named alike.
        sections.forEach((entry, id) => this.add({
            id, heading: parts(entry.heading), page: entry.page, words: parts(entry.words)
        }, { boost: entry.target.startsWith("api/") ? 0.3 : 1 }));
    });

    const find = (text) => {
        const words = text.toLowerCase().match(/[^\s:~^*+]+/g) || [];
        return words.length === 0 ? [] : index.query((query) => words.forEach((word) => {
            query.term(lunr.tokenizer(word), { boost: 10 });
            query.term(lunr.tokenizer(word), {
                usePipeline: false, wildcard: lunr.Query.wildcard.TRAILING });
        }));
    };

    // The words around the first place where one of those sought stands.
    const around = (words, text) => {
        const low = words.toLowerCase();
        const places = text.toLowerCase().split(/\s+/).map((word) => low.indexOf(word))
            .filter((place) => place >= 0);
        const start = Math.max(0, (places.length ? Math.min(...places) : 0) - 40);
        return (start > 0 ? "... " : "") + words.slice(start, start + 120);
    };

    const show = () => {
        index = index || build();
        list.replaceChildren(...find(field.value).slice(0, most).map((hit) => {
            const entry = sections[hit.ref], item = document.createElement("li");
            const link = document.createElement("a"), words = document.createElement("span");
            link.href = entry.target;
            link.textContent = entry.heading === entry.page ? entry.page
                : entry.page + ": " + entry.heading;
            words.textContent = around(entry.words, field.value);
            item.append(link, words);
            return item;
        }));
        if (list.childElementCount === 0 && field.value.trim() !== "")
            list.append(Object.assign(document.createElement("li"), { textContent: "nothing" }));
    };

    field.addEventListener("input", show);
    field.addEventListener("keydown", (event) => {
        const first = list.querySelector("a");
        if (event.key === "Escape") { field.value = ""; show(); }
        if (event.key === "Enter" && first) first.click();
    });
    document.addEventListener("keydown", (event) => {
        if (event.key === "/" && document.activeElement !== field) {
            event.preventDefault();
            field.focus();
        }
    });
}
